# What the sanitizer steps of deploy/test build: all tests but the end-to-end ones. `deploy/test --full` builds and runs everything, the
# daemons in their end-to-end tests included.
set(interlace_sanitized app_tests client_tests config_tests core_tests model_tests model_walk_tests planner_lossy reproduce_tests proxy_unit
                        core_properties model_properties standoff_tests
                        dissertation_regressions)
if(INTERLACE_DDS)
  list(APPEND interlace_sanitized dds_round_trip_test dds_refusal_test dds_mutation_test dds_practice_test dds_cyclone_test)
endif()
add_custom_target(sanitized_tests DEPENDS ${interlace_sanitized})
