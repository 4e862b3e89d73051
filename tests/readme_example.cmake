# Builds examples/cpp/register_two_clouds.cc. tests/docs/commands_test.py checks
# that README.md shows the same program.
add_executable(readme_example "${PROJECT_SOURCE_DIR}/examples/cpp/register_two_clouds.cc")
target_link_libraries(readme_example PRIVATE quatro::quatro)
quatro_target(readme_example)
set_target_properties(readme_example PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/tests")
