# The programs. Each is one translation unit: every source that reads CLI11 compiles all of it.
function(natator_program program)
    set(cli ${PROJECT_SOURCE_DIR}/sim-native/cli)
    list(TRANSFORM ARGN PREPEND ${cli}/)
    add_executable(${program} ${ARGN} ${cli}/backend.cpp ${cli}/options.cpp ${cli}/program.cpp)
    target_link_libraries(${program} PRIVATE natator CLI11::CLI11 nlohmann_json::nlohmann_json)
    target_compile_options(${program} PRIVATE ${NATATOR_WARNINGS} ${NATATOR_PROGRAM_OPTIMISATION})
    target_link_options(${program} PRIVATE ${NATATOR_BUILD_ID})
    target_include_directories(${program} PRIVATE ${PROJECT_SOURCE_DIR}/sim-native/src)
    if(EMSCRIPTEN)  # run by node, with the files of the machine
        target_link_options(${program} PRIVATE -O1 -sNODERAWFS=1 -sSINGLE_FILE=1 -sENVIRONMENT=node -sEXIT_RUNTIME=1 -sALLOW_MEMORY_GROWTH=1)
    endif()
    set_target_properties(${program} PROPERTIES UNITY_BUILD ${NATATOR_UNITY_BUILD} UNITY_BUILD_BATCH_SIZE 0)
    if(CMAKE_SYSTEM_NAME STREQUAL Linux AND NOT NATATOR_SANITIZE)
        # A wheel's program runs where libstdc++ is older or missing; what it does not use of it would need a newer C library.
        target_link_options(${program} PRIVATE -static-libstdc++ LINKER:--gc-sections)
    endif()
endfunction()

natator_program(natator-sim
    commit.cpp
    converge.cpp
    convergence_report.cpp
    evaluate.cpp
    gait_argument.cpp
    info.cpp
    job.cpp
    json_argument.cpp
    level_runs.cpp
    line_queue.cpp
    main.cpp
    output_file.cpp
    particles.cpp
    policy.cpp
    run.cpp
    run_record.cpp
    serve.cpp
    start_bench.cpp
    stream.cpp
    stream_batch.cpp
    stream_session.cpp)

# The simulator of the page that natator page --live writes, with its data inside.
if(EMSCRIPTEN)
    add_executable(natator-live cli/live.cpp cli/policy.cpp cli/stream_session.cpp)
    target_link_libraries(natator-live PRIVATE natator nlohmann_json::nlohmann_json)
    target_compile_options(natator-live PRIVATE ${NATATOR_WARNINGS} ${NATATOR_PROGRAM_OPTIMISATION})
    target_include_directories(natator-live PRIVATE ${PROJECT_SOURCE_DIR}/sim-native/src)
    target_link_options(natator-live PRIVATE --no-entry -sMODULARIZE=1 -sEXPORT_NAME=natatorLive -sENVIRONMENT=web,worker,node
        -sALLOW_MEMORY_GROWTH=1 -sEXPORTED_RUNTIME_METHODS=ccall -sNODEJS_CATCH_EXIT=0 -sNODEJS_CATCH_REJECTION=0
        "SHELL:--embed-file ${CMAKE_CURRENT_SOURCE_DIR}/scenes@/share/natator/scenes"
        "SHELL:--embed-file ${CMAKE_CURRENT_SOURCE_DIR}/creatures@/share/natator/creatures")
    file(GLOB_RECURSE NATATOR_LIVE_DATA CONFIGURE_DEPENDS scenes/*.json creatures/*)
    set_target_properties(natator-live PROPERTIES LINK_DEPENDS "${NATATOR_LIVE_DATA}")
endif()

# What natator-sim bench starts; who only evolves does without it.
if(NATATOR_SANITIZE)
    add_subdirectory(bench EXCLUDE_FROM_ALL)
else()
    add_subdirectory(bench)
endif()

# The Java half under a name of its own, beside them.
configure_file(cli/natator.sh ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/natator COPYONLY)

# At every build, not when CMake configures: a commit does not make it configure again.
set(NATATOR_COMMIT_DIR ${CMAKE_CURRENT_BINARY_DIR}/commit)
add_custom_target(natator-commit BYPRODUCTS ${NATATOR_COMMIT_DIR}/natator_commit.h
    COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D OUTPUT=${NATATOR_COMMIT_DIR}/natator_commit.h
        -P ${CMAKE_CURRENT_SOURCE_DIR}/commit.cmake)
add_dependencies(natator-sim natator-commit)
set_source_files_properties(cli/commit.cpp PROPERTIES
    INCLUDE_DIRECTORIES ${NATATOR_COMMIT_DIR} SKIP_PRECOMPILE_HEADERS ON)

# The programs find their scenes beside themselves, wherever the build folder is copied to. Editors find the schemas there.
file(GLOB NATATOR_SCHEMAS CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/protocol/*.schema.json)
add_custom_target(natator-data ALL
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${CMAKE_CURRENT_SOURCE_DIR}/scenes ${PROJECT_BINARY_DIR}/share/natator/scenes
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${CMAKE_CURRENT_SOURCE_DIR}/creatures ${PROJECT_BINARY_DIR}/share/natator/creatures
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${CMAKE_CURRENT_SOURCE_DIR}/references ${PROJECT_BINARY_DIR}/share/natator/references
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${CMAKE_CURRENT_SOURCE_DIR}/examples/gaits ${PROJECT_BINARY_DIR}/share/natator/gaits
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/share/natator/protocol
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${NATATOR_SCHEMAS} ${PROJECT_BINARY_DIR}/share/natator/protocol)
add_dependencies(natator-sim natator-data)
add_dependencies(natator-bench natator-data)
