# Target interlace_page: the page of interlace-monitor, built by Vite from a copy of its sources in the build tree, never in the sources, and
# only when they have changed. It lands where the program looks for it: share/interlace/monitor beside its own folder.
set(INTERLACE_PAGE_SOURCE ${PROJECT_SOURCE_DIR}/monitor/web)
set(INTERLACE_PAGE_BUILD ${PROJECT_BINARY_DIR}/web CACHE INTERNAL "Copy of the page's sources, with its node_modules")
set(INTERLACE_PAGE_DIR ${PROJECT_BINARY_DIR}/share/interlace/monitor CACHE INTERNAL "The built page")

# interlace_page(FILE...): the page is made of these files, relative to monitor/web.
function(interlace_page)
  set(_copies)
  foreach(file ${ARGN})
    list(APPEND _copies ${INTERLACE_PAGE_BUILD}/${file})
    add_custom_command(
      OUTPUT ${INTERLACE_PAGE_BUILD}/${file}
      COMMAND ${CMAKE_COMMAND} -E copy ${INTERLACE_PAGE_SOURCE}/${file} ${INTERLACE_PAGE_BUILD}/${file}
      DEPENDS ${INTERLACE_PAGE_SOURCE}/${file}
      COMMENT "" VERBATIM)
  endforeach()
  # Nothing that a package brings along runs while it is installed.
  add_custom_command(
    OUTPUT ${INTERLACE_PAGE_BUILD}/installed
    COMMAND ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch installed
    DEPENDS ${INTERLACE_PAGE_BUILD}/package.json ${INTERLACE_PAGE_BUILD}/package-lock.json
    WORKING_DIRECTORY ${INTERLACE_PAGE_BUILD}
    COMMENT "Installing what the page is built with" VERBATIM)
  add_custom_command(
    OUTPUT ${INTERLACE_PAGE_DIR}/index.html
    COMMAND ${CMAKE_COMMAND} -E env INTERLACE_PAGE_DIR=${INTERLACE_PAGE_DIR} ${NODE} node_modules/vite/bin/vite.js build --logLevel error
    DEPENDS ${_copies} ${INTERLACE_PAGE_BUILD}/installed
    WORKING_DIRECTORY ${INTERLACE_PAGE_BUILD}
    COMMENT "Building the page of interlace-monitor" VERBATIM)
  add_custom_target(interlace_page ALL DEPENDS ${INTERLACE_PAGE_DIR}/index.html)
endfunction()
