# The installable package: libraries, headers, the program and the files by which find_package(clues) finds them
# (targets clues::scene, clues::exact, clues::fastpath, clues::reference, clues::validate, clues::fuzz).
include(CMakePackageConfigHelpers)

install(TARGETS clues_scene clues_exact clues_fastpath clues_reference clues_validate clues_fuzz
  EXPORT cluesTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS clues RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

foreach(folder scene exact fastpath reference validate fuzz)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clues
    FILES_MATCHING PATTERN "*.h" PATTERN "adapters" EXCLUDE PATTERN "clues_iut.h" EXCLUDE)
endforeach()
install(FILES LICENSE NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR})
# For whoever is tested: the C header, the adapters to copy, and the suite, which `clues conform` finds beside itself.
install(FILES validate/clues_iut.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY validate/adapters vectors DESTINATION ${CMAKE_INSTALL_DATADIR}/clues)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/clues)
install(EXPORT cluesTargets NAMESPACE clues:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/cluesConfig.cmake.in ${PROJECT_BINARY_DIR}/cluesConfig.cmake
  INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/cluesConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/cluesConfig.cmake ${PROJECT_BINARY_DIR}/cluesConfigVersion.cmake
  DESTINATION ${package_dir})
