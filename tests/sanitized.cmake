# What the sanitizer steps of deploy/test build. `deploy/test --full` builds and runs everything under both, the daemons in their end-to-end
# tests included.

# Everything that runs more than one thread: what the thread sanitizer can find something in. The web server's sources take so long to
# compile that its test runs under the sanitizers with --full alone.
set(interlace_threaded app_tests proxy_unit simulator_tests)
if(INTERLACE_DDS)
  list(APPEND interlace_threaded dds_round_trip_test dds_refusal_test dds_mutation_test dds_practice_test dds_cyclone_test
       dds_ros2_test)
endif()
if(INTERLACE_DDS)
  set(interlace_of_recordings playback_tests dds_journal_test)
endif()
add_custom_target(threaded_tests DEPENDS ${interlace_threaded})

# All tests but the end-to-end ones.
add_custom_target(sanitized_tests DEPENDS ${interlace_threaded} ${interlace_of_recordings} client_tests config_tests core_tests mcap_tests mesh_tests model_tests model_walk_tests modeller_tests monitor_tests planner_lossy planner_promises
                                          report_tests reproduce_tests ros2_tests core_properties model_properties ros2_properties standoff_tests dissertation_regressions)
