# cmake --install: the library as a CMake package, the programs, and the data that they find beside themselves
# (../share/natator of the program's folder), wherever the prefix is moved to. Component `program`: what a wheel brings;
# `evolution`: the Java half.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(NATATOR_DATA_DIR share/natator)
set(NATATOR_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/natator)

install(TARGETS natator EXPORT natatorTargets)
install(DIRECTORY include/natator ${CMAKE_CURRENT_BINARY_DIR}/include/natator DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h")
install(EXPORT natatorTargets NAMESPACE natator:: DESTINATION ${NATATOR_PACKAGE_DIR})
configure_package_config_file(cmake/natatorConfig.cmake.in natatorConfig.cmake
    INSTALL_DESTINATION ${NATATOR_PACKAGE_DIR} PATH_VARS NATATOR_DATA_DIR)
write_basic_package_version_file(natatorConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/natatorConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/natatorConfigVersion.cmake
    DESTINATION ${NATATOR_PACKAGE_DIR})

if(NATATOR_PROGRAMS)
    if(BUILD_SHARED_LIBS)
        set_target_properties(natator-sim natator-bench PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
    endif()
    install(TARGETS natator-sim RUNTIME DESTINATION bin COMPONENT program)
    install(TARGETS natator-bench RUNTIME DESTINATION bin OPTIONAL)  # natator-sim does without it
    install(PROGRAMS cli/natator.sh DESTINATION bin RENAME natator COMPONENT evolution)
    install(FILES ${PROJECT_SOURCE_DIR}/ga-java/target/natator.jar DESTINATION ${NATATOR_DATA_DIR} COMPONENT evolution OPTIONAL)
    foreach(part js wasm)  # of cmake --preset wasm
        install(FILES ${PROJECT_SOURCE_DIR}/build/wasm/bin/natator-live.${part}
            DESTINATION ${NATATOR_DATA_DIR}/live COMPONENT evolution OPTIONAL)
    endforeach()
endif()
install(DIRECTORY scenes creatures examples/gaits DESTINATION ${NATATOR_DATA_DIR} COMPONENT program)
install(DIRECTORY protocol DESTINATION ${NATATOR_DATA_DIR} COMPONENT program FILES_MATCHING PATTERN "*.schema.json")
install(DIRECTORY references DESTINATION ${NATATOR_DATA_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/natator)

if(NATATOR_PROGRAMS AND PROJECT_IS_TOP_LEVEL AND NOT SKBUILD)
    include(cmake/deb.cmake)
endif()
