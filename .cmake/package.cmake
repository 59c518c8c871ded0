# `./run package`: a Debian package of the program, the libraries with their headers, the conformance suite, man pages and
# the completion of bash. The man pages are made from `clues COMMAND --help` (target clues_man; help2man).
find_program(HELP2MAN help2man)
if(HELP2MAN)
  set(man ${PROJECT_BINARY_DIR}/man)
  add_custom_command(OUTPUT ${man}/clues.1.gz
    COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:clues> -DVERSION=${PROJECT_VERSION} -DHELP2MAN=${HELP2MAN}
      -DMAN=${man} -P ${CMAKE_CURRENT_LIST_DIR}/man_pages.cmake
    DEPENDS clues ${CMAKE_CURRENT_LIST_DIR}/man_pages.cmake VERBATIM)
  add_custom_target(clues_man DEPENDS ${man}/clues.1.gz)
  install(DIRECTORY ${man}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 OPTIONAL)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/app/completion/clues.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME clues)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the authors of clues <clues@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For those who build against the libraries.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "libcgal-dev, nlohmann-json3-dev, libssl-dev, libtbb-dev, libfmt-dev, libopenmesh-dev, libsqlite3-dev, libzstd-dev, bash-completion")
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
include(CPack)
