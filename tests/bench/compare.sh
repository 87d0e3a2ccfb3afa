#!/bin/sh
# Puts standard input between the marks of that name in COMPARE.md, and prints it: `./compile_time.sh | ./compare.sh compile`.
set -e
file=$(dirname "$0")/../../COMPARE.md
text=$(mktemp)
trap 'rm -f "$text" "$text.md"' EXIT
tee "$text"
grep -q "<!-- begin $1 -->" "$file" && grep -q "<!-- end $1 -->" "$file" || { echo "COMPARE.md has no marks for $1" >&2; exit 1; }
awk -v name="$1" -v text="$text" '
    $0 == "<!-- end " name " -->" { print ""; inside = 0 }
    !inside
    $0 == "<!-- begin " name " -->" { inside = 1; print ""; while ((getline line < text) > 0) print line }
' "$file" > "$text.md"
cat "$text.md" > "$file"
