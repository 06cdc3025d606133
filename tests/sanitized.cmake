# What the sanitizer steps of deploy/test build. Everything that has threads, for the thread sanitizer; all tests but the end-to-end ones
# for the other two. `deploy/test --full` builds and runs everything under both, the daemons in their end-to-end tests included.
set(interlace_threaded app_tests client_tests proxy_unit planner_lossy)
set(interlace_sanitized ${interlace_threaded} config_tests core_tests model_tests core_properties model_properties dissertation_regressions)
if(INTERLACE_DDS)
  set(interlace_dds_tests dds_round_trip_test dds_refusal_test dds_mutation_test dds_practice_test dds_cyclone_test)
  list(APPEND interlace_threaded ${interlace_dds_tests})
  list(APPEND interlace_sanitized ${interlace_dds_tests})
endif()
add_custom_target(threaded_tests DEPENDS ${interlace_threaded})
add_custom_target(sanitized_tests DEPENDS ${interlace_sanitized})
