# npm_modules(folder comment): npm packages as package-lock.json of the folder that calls has them, with their hashes, in the build's
# folder of this name; `${folder}/installed` is there when they are. From the npm registry: it needs the network.
function(npm_modules folder comment)
  add_custom_command(OUTPUT ${folder}/installed
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_CURRENT_SOURCE_DIR}/package.json ${CMAKE_CURRENT_SOURCE_DIR}/package-lock.json ${folder}
    COMMAND ${CMAKE_COMMAND} -E chdir ${folder} ${NPM} ci --ignore-scripts --no-audit --no-fund --loglevel=error
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/installed
    DEPENDS package.json package-lock.json
    COMMENT "${comment}"
    VERBATIM)
endfunction()
