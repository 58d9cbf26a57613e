# Copyright, changelog and manual pages of the Debian package, into $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share. A page is what the
# program says of itself by --help. Reads PROGRAM, SOURCE, VERSION and CONTACT.
set(jar ${SOURCE}/ga-java/target/natator.jar)
set(share $ENV{DESTDIR}${CMAKE_INSTALL_PREFIX}/share)

function(said)
    execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE output RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${ARGV}: ${status}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

function(write_compressed name text)
    file(WRITE ${share}/${name} "${text}")
    execute_process(COMMAND gzip -9nf ${share}/${name} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(manual_page name summary)
    said(${ARGN} --version)
    if(NOT output MATCHES "^${name} ([0-9.]+)" OR NOT CMAKE_MATCH_1 STREQUAL VERSION)
        string(STRIP "${output}" output)
        message(FATAL_ERROR "${ARGN} is ${output}: must be of version ${VERSION}; build it again")
    endif()
    said(${ARGN} --help)
    string(REPLACE "\\" "\\e" text "${output}")
    string(REPLACE "-" "\\-" text "${text}")
    string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
    string(REPLACE "-" "\\-" name_shown ${name})
    write_compressed(man/man1/${name}.1 ".TH ${name} 1 \"\" \"Natator ${VERSION}\"\n.SH NAME\n${name_shown} \\- ${summary}\n\
.SH DESCRIPTION\n.nf\n${text}.fi\n")
endfunction()

if(NOT EXISTS ${jar})
    message(FATAL_ERROR "no ${jar}: must be made first, by mvn package -DskipTests")
endif()
manual_page(natator-sim "simulates swimming soft creatures" ${PROGRAM})
manual_page(natator "evolves gaits of swimming soft creatures" java -jar ${jar})

file(READ ${SOURCE}/sim-native/python/THIRD-PARTY.txt third_party)
file(WRITE ${share}/doc/natator/copyright "Natator. Copyright 2026 the Natator maintainers
Licensed under the Apache License, version 2.0: /usr/share/common-licenses/Apache-2.0

What natator.jar holds besides is in its META-INF/THIRD-PARTY.txt, with notices in META-INF/NOTICE and licences in META-INF/licenses.
Of it JGAP and Trove are under the GNU Lesser General Public License, version 2.1: /usr/share/common-licenses/LGPL-2.1

${third_party}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
write_compressed(doc/natator/changelog "natator (${VERSION}) unstable; urgency=medium\n\n  * As CHANGELOG.md of the source says.\n\n -- ${CONTACT}  ${date}\n")
