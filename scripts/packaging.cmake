# Installation beyond what each folder installs itself, and the Debian packages (cpack -G DEB).
# Component `seautils` is the tools with all that they need; `dev` the libraries and headers.
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/seautils)
install(EXPORT seautilsTargets NAMESPACE seautils:: DESTINATION ${config_dir} COMPONENT dev)
configure_package_config_file(scripts/seautilsConfig.cmake.in
  ${PROJECT_BINARY_DIR}/packaging/seautilsConfig.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/packaging/seautilsConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/packaging/seautilsConfig.cmake
              ${PROJECT_BINARY_DIR}/packaging/seautilsConfigVersion.cmake
        DESTINATION ${config_dir} COMPONENT dev)

# The folders are found from the place of the .pc file, so that the installation can be moved.
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" to_prefix ${to_prefix})
# What only tools need is left out; what depends on others stands before them.
set(libraries ${SEAUTILS_MODULES})
list(REMOVE_ITEM libraries cli)
list(REVERSE libraries)
list(TRANSFORM libraries PREPEND -lseautils_)
list(JOIN libraries " " SEAUTILS_PC_LIBS)
configure_file(scripts/seautils.pc.in packaging/seautils.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/packaging/seautils.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

# Completion reads --help; nothing of it is written by hand.
foreach(tool ${SEAUTILS_TOOLS})
  set(completion ${PROJECT_BINARY_DIR}/packaging/completions/${tool})
  file(CONFIGURE OUTPUT ${completion} CONTENT "complete -F _longopt ${tool}\n")
  install(FILES ${completion} DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
          COMPONENT seautils)
endforeach()
list(JOIN SEAUTILS_TOOLS " " tools)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/packaging/_seautils
     CONTENT "#compdef ${tools}\n_gnu_generic \"$@\"\n")
install(FILES ${PROJECT_BINARY_DIR}/packaging/_seautils
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT seautils)

install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT seautils OPTIONAL)
install(FILES schemas/README.md RENAME schemas.md DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT seautils)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT seautils
        USE_SOURCE_PERMISSIONS)
install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DOCDIR}
        COMPONENT seautils OPTIONAL)
install(FILES LICENSE RENAME copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libseautils-dev
        COMPONENT dev OPTIONAL)
# The examples find the schemas beside their folder, as in the source.
file(RELATIVE_PATH to_schemas /${CMAKE_INSTALL_DOCDIR} /${CMAKE_INSTALL_DATADIR}/seautils/schemas)
install(CODE "
  set(docs \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DOCDIR}\")
  file(MAKE_DIRECTORY \"\${docs}\")
  file(CREATE_LINK ${to_schemas} \"\${docs}/schemas\" SYMBOLIC)" COMPONENT seautils)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR seautils)
set(CPACK_PACKAGE_CONTACT "The seautils maintainers <maintainers@seautils.example>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL seautils dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/scripts/debian-layout.cmake)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${PROJECT_HOMEPAGE_URL})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_SEAUTILS_PACKAGE_NAME seautils)
set(CPACK_DEBIAN_SEAUTILS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SEAUTILS_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_SEAUTILS_DESCRIPTION
"Messages of the Dynamic Compact Control Language (DCCL) encoded, decoded and
inspected, and the acoustic link that they travel on: queues, turns to speak,
WHOI Micro-Modems, and a simulation of both modems and sea. With message
schemas, manual pages, examples and shell completion.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libseautils-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS seautils)
set(needed libboost-program-options-dev libcli11-dev libcrypto++-dev libfmt-dev libgeographiclib-dev liblua5.3-dev
    libprotobuf-dev libprotoc-dev libpugixml-dev libsimdjson-dev libsqlite3-dev pkgconf)
list(JOIN needed ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
set(CPACK_COMPONENT_DEV_DESCRIPTION
"Development files: the static libraries and headers behind the tools. The DCCL
codec, protobuf schemas at run time, their JSON, text and CSV forms.")
include(CPack)
