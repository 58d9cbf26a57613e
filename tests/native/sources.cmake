# Test sources, relative to this directory (the solver_* tests are listed in tests/CMakeLists.txt).
set(NATATOR_TEST_SOURCES
    creatures_test.cpp
    evaluate_test.cpp
    gait_test.cpp
    measure_test.cpp
    model_test.cpp
    muscles_test.cpp
    reference_model_test.cpp
    scene_bad_input_test.cpp
    scene_test.cpp
    strict_json_test.cpp
    ../protocol/bad_request_test.cpp
    ../protocol/child_process.cpp
    ../protocol/evaluate_protocol_test.cpp
    ../protocol/run_and_info_test.cpp)
