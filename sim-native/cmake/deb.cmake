# cpack --preset deb: a package for Debian and Ubuntu with natator-sim, its data, and natator with its jar.
set(CPACK_COMPONENTS_ALL program evolution deb)
set(CPACK_COMPONENTS_GROUPING ALL_COMPONENTS_IN_ONE)
set(CPACK_PACKAGE_CONTACT "The Natator developers <maintainers@natator.io>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "simulator of swimming soft creatures, and evolution of their gaits")
set(CPACK_PACKAGE_DESCRIPTION "Natator simulates soft creatures and the water around them as particles, and
evolves the gaits by which they swim. The simulator natator-sim runs on the
CPU; natator evolves gaits, compares them, and shows swims in a browser.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "default-jre-headless (>= 2:1.17) | java17-runtime-headless")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
include(CPack)

# Files that Debian asks for.
install(CODE "
    set(PROGRAM \"$<TARGET_FILE:natator-sim>\")
    set(SOURCE \"${PROJECT_SOURCE_DIR}\")
    set(VERSION \"${PROJECT_VERSION}\")
    set(CONTACT \"${CPACK_PACKAGE_CONTACT}\")"
    COMPONENT deb EXCLUDE_FROM_ALL)
install(SCRIPT cmake/deb_documents.cmake COMPONENT deb EXCLUDE_FROM_ALL)
