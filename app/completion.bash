# SPDX-License-Identifier: GPL-3.0-or-later
# Completion of `talus` for bash. Verbs, options, scenes and keys are asked of the program itself, so that they are those
# of the one that is called.

# The first word of each indented line after a heading of `talus --help`.
_talus_verbs() { "$1" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'; }
_talus_options() { "$1" "$2" --help 2>/dev/null | sed -n '/^Options:/,/^$/s/^  \(-[^ ]*\).*/\1/p' | tr , '\n'; }
_talus_choices() { "$1" "$2" --help 2>/dev/null | sed -n "s/^  $3 .*{\(.*\)}.*/\1/p" | tr , '\n'; }
_talus_scenes() { "$1" list 2>/dev/null | cut -d ' ' -f 1; }
_talus_tables() { "$1" keys 2>/dev/null | sed -n 's/^\([a-z_]*\)$/\1/p'; }
# Keys of the tables that a scene has once; others need a name or an index, which only the scene knows.
_talus_keys()
{
  "$1" keys 2>/dev/null | awk '/^[a-z_.]+$/ {table = $1} /^$/ {table = ""}
    /^  [a-z_]+ / && table ~ /^(time|world|solver|output|checkpoint)$/ {print table "." $1 "="}'
}

_talus()
{
  COMPREPLY=()
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} verb=${COMP_WORDS[1]}
  ((COMP_CWORD > 1)) || { COMPREPLY=($(compgen -W "$(_talus_verbs "$1") --help --version" -- "$word")); return; }

  case $before in
    --set)
      compopt -o nospace
      COMPREPLY=($(compgen -W "$(_talus_keys "$1")" -- "$word"))
      return ;;
    --from)
      COMPREPLY=($(compgen -W "$(_talus_scenes "$1")" -- "$word"))
      return ;;
    --algorithm | --format | --local | --order)
      COMPREPLY=($(compgen -W "$(_talus_choices "$1" "$verb" "$before")" -- "$word"))
      return ;;
    -o | --out | --output | --log-file | --settings | --history)
      compopt -o filenames
      COMPREPLY=($(compgen -f -- "$word"))
      return ;;
    --accuracy | --at | --case | --frames | --guess | --jobs | --max-sweeps | --omega | --seed | --threads | --tolerance | --until) return ;;
  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$(_talus_options "$1" "$verb")" -- "$word"))
    return
  fi
  case $verb in
    run | check | dump | export | study)
      compopt -o filenames
      COMPREPLY=($(compgen -W "$(_talus_scenes "$1")" -- "$word") $(compgen -d -- "$word") $(compgen -f -X '!*.toml' -- "$word")) ;;
    sweep | calibrate)
      compopt -o filenames
      COMPREPLY=($(compgen -d -- "$word") $(compgen -f -X '!*.toml' -- "$word")) ;;
    resume | report | watch | gather)
      compopt -o filenames
      COMPREPLY=($(compgen -d -- "$word")) ;;
    solve)
      compopt -o filenames
      COMPREPLY=($(compgen -d -- "$word") $(compgen -f -X '!*.hdf5' -- "$word")) ;;
    keys) COMPREPLY=($(compgen -W "$(_talus_tables "$1")" -- "$word")) ;;
    *)
      compopt -o filenames
      COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}
complete -F _talus talus
