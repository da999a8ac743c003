# find_package(mechaudit): the targets mechaudit::mechaudit (shared) and mechaudit::static, and the path of the
# Fortran module's source, mechaudit_FORTRAN_MODULE. Relocatable: everything is sought beside this file.
get_filename_component(_mechaudit_share "${CMAKE_CURRENT_LIST_DIR}" PATH)
get_filename_component(_mechaudit_prefix "${_mechaudit_share}/../.." ABSOLUTE)
set(mechaudit_INCLUDE_DIR "${_mechaudit_prefix}/include")
set(mechaudit_FORTRAN_MODULE "${_mechaudit_share}/fortran/mechaudit.f90")

file(GLOB _mechaudit_folders "${_mechaudit_prefix}/lib*" "${_mechaudit_prefix}/lib/*-*-*")
function(_mechaudit_library name target kind)
    find_library(_mechaudit_${kind} NAMES ${name} PATHS ${_mechaudit_folders} NO_DEFAULT_PATH NO_CACHE)
    if(_mechaudit_${kind} AND NOT TARGET ${target})
        add_library(${target} ${kind} IMPORTED GLOBAL)
        set_target_properties(${target} PROPERTIES
            IMPORTED_LOCATION "${_mechaudit_${kind}}"
            INTERFACE_INCLUDE_DIRECTORIES "${mechaudit_INCLUDE_DIR}")
    endif()
endfunction()
_mechaudit_library("${CMAKE_SHARED_LIBRARY_PREFIX}mechaudit${CMAKE_SHARED_LIBRARY_SUFFIX}" mechaudit::mechaudit SHARED)
_mechaudit_library("${CMAKE_STATIC_LIBRARY_PREFIX}mechaudit${CMAKE_STATIC_LIBRARY_SUFFIX}" mechaudit::static STATIC)
if(TARGET mechaudit::static AND UNIX)
    # What Rust's standard library needs.
    set_property(TARGET mechaudit::static PROPERTY INTERFACE_LINK_LIBRARIES pthread m ${CMAKE_DL_LIBS})
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(mechaudit
    REQUIRED_VARS mechaudit_INCLUDE_DIR
    VERSION_VAR mechaudit_VERSION)
if(NOT TARGET mechaudit::mechaudit AND NOT TARGET mechaudit::static)
    set(mechaudit_FOUND FALSE)
    set(mechaudit_NOT_FOUND_MESSAGE "no library of mechaudit in ${_mechaudit_folders}")
endif()
