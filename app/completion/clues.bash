# Completion of `clues` for bash: commands and options as the program's own help lists them, and files.
_clues() {
  local current=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} help words
  if [ "$COMP_CWORD" -eq 1 ]; then
    help=$("$program" --help 2>/dev/null) || return
    words=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p' <<<"$help")
  else
    help=$("$program" "${COMP_WORDS[1]}" --help 2>/dev/null) || return
  fi
  case $current in
    -*) words=$(grep -oE '^ +(-[a-z],)?--[a-z][a-z-]*' <<<"$help" | grep -oE -- '--[a-z-]+') ;;
    *) [ "$COMP_CWORD" -eq 1 ] || words= ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
} && complete -o default -F _clues clues
