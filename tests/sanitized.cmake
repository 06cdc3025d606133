# What the sanitizer steps of deploy/test build: what handles bytes from outside, and the planner's core. Sources take three to five times as long
# to compile for a sanitizer, so the rest waits for `deploy/test --full`, which builds and runs everything under both, the daemons in their
# end-to-end tests included.

# What runs more than one thread: what the thread sanitizer can find something in.
set(interlace_threaded app_tests proxy_unit)
set(interlace_of_messages)
if(INTERLACE_DDS)
  set(interlace_of_messages dds_round_trip_test dds_refusal_test dds_mutation_test dds_practice_test dds_cyclone_test)
endif()
add_custom_target(threaded_tests DEPENDS ${interlace_threaded} ${interlace_of_messages})

add_custom_target(sanitized_tests DEPENDS ${interlace_of_messages} config_tests core_tests mcap_tests mesh_tests model_tests planner_lossy planner_promises)
