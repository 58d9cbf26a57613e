# Builds the examples in the folder `build` against the package in `prefix`, and runs them; and a program that keeps a settled
# start, with and without a build id.
function(run_against prefix build)
    file(GLOB targets ${prefix}/lib*/cmake/natator/natatorTargets.cmake ${prefix}/lib*/*/cmake/natator/natatorTargets.cmake)
    file(STRINGS ${targets} flags REGEX "INTERFACE_LINK_OPTIONS")
    if(flags)
        message(FATAL_ERROR "${targets} has ${flags}; expected no linker flag for users")
    endif()
    set(options -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${prefix}
        -DCUDAToolkit_ROOT=${CUDA})
    run(${CMAKE_COMMAND} -S ${SOURCE}/sim-native/examples -B ${build} ${options})
    run(${CMAKE_COMMAND} --build ${build})
    run(${build}/falling_drop)
    expect("\n +1\\.0 +0\\.[0-9]+ +[0-9.]+\n")
    file(GLOB shared ${prefix}/lib*/libnatator.so ${prefix}/lib*/*/libnatator.so)
    if(NOT shared)  # which is not optimised, see add_and_install.cmake
        run(${CMAKE_COMMAND} -E env --unset=NATATOR_DATA ${build}/swimmer)
        expect("completed after 1\\.00 s: swam")
        run(${CMAKE_COMMAND} -E env --unset=NATATOR_DATA ${build}/driven)
        expect("swam 0\\.[0-9]+ units, work [0-9]+")
    endif()

    # What holds the library's code must have a build id: the program, or the shared library, which has one.
    run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/keeps -B ${build}/keeps ${options})
    run(${CMAKE_COMMAND} --build ${build}/keeps)
    run(${build}/keeps/keeps ${build}/keeps/starts)
    expect("kept: 1")
    run(${build}/keeps/keeps_without_id ${build}/keeps/others)
    if(shared)
        expect("kept: 1")
    else()
        expect("kept: 0")
    endif()
endfunction()
