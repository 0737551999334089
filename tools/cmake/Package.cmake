# Debian packages of everything that has an install rule: the build target "package", which tools/package.sh builds. The
# project's CMakeLists.txt includes this file last, because include(CPack) reads its variables at once.
include(GNUInstallDirs)
foreach(text README.md LICENSE THIRD_PARTY.md CHANGELOG.md)
    if(EXISTS ${PROJECT_SOURCE_DIR}/${text})
        install(FILES ${PROJECT_SOURCE_DIR}/${text} DESTINATION ${CMAKE_INSTALL_DOCDIR})
    endif()
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "the globular authors")
set(CPACK_PACKAGE_CONTACT "the globular authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
# dpkg-shlibdeps finds the packages of the libraries. ffmpeg is a program that globular runs, for videos; gnuplot draws the
# plots of the studies; EGL, which is not the default, draws with Mesa's drivers.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS ffmpeg)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox, libgl1-mesa-dri")
# globular-mpi is a package of its own, so that the other one does not need MPI.
if(GLOBULAR_HAS_MPI)
    set(CPACK_DEB_COMPONENT_INSTALL ON)
    set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME globular)
    set(CPACK_DEBIAN_MPI_PACKAGE_NAME globular-mpi)
    set(CPACK_DEBIAN_MPI_PACKAGE_DEPENDS "globular (= ${PROJECT_VERSION}), openmpi-bin")
    set(CPACK_DEBIAN_MPI_PACKAGE_RECOMMENDS "")
    set(CPACK_DEBIAN_MPI_DESCRIPTION "${PROJECT_DESCRIPTION}, simulated by several processes")
endif()
# Readable by all users, as Debian requires, whatever the umask of the build is.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
