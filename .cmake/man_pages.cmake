# PROGRAM, VERSION, HELP2MAN, MAN: writes clues.1.gz, and clues-COMMAND.1.gz for each command that the help lists, into the
# folder MAN. The line under NAME is the first line of the help.
function(page words name)
  execute_process(COMMAND ${PROGRAM} ${words} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "^[^\n]*" what "${help}")
  string(REGEX REPLACE "^clues - " "" what "${what}")
  execute_process(
    COMMAND ${HELP2MAN} --no-info "--version-string=clues ${VERSION}" "--name=${what}" --output=${MAN}/${name}.1 "${PROGRAM} ${words}"
    COMMAND_ERROR_IS_FATAL ANY)
  file(READ ${MAN}/${name}.1 text)
  string(REPLACE ".TH CLUES " ".TH ${name} " text "${text}")
  string(REPLACE "\nclues \\- " "\n${name} \\- " text "${text}")
  file(WRITE ${MAN}/${name}.1 "${text}")
  execute_process(COMMAND gzip -9nf ${MAN}/${name}.1 COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${MAN})
file(MAKE_DIRECTORY ${MAN})
execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE ".*\nSubcommands:\n(.*)\n\nEXAMPLES.*" "\\1" commands "${help}")
string(REGEX MATCHALL "(^|\n)  [a-z]+" commands "${commands}")
list(TRANSFORM commands STRIP)
foreach(command IN LISTS commands)
  page(${command} clues-${command})
endforeach()
page("" clues)
