#!/bin/sh
# Puts standard input between the marks of that name in COMPARE.md, or in another page of the root, and prints it:
# `./compile_time.sh | ./compare.sh compile`, `./compare.sh short README.md < short.md`.
set -e
page=${2:-COMPARE.md}
file=$(dirname "$0")/../../$page
text=$(mktemp)
trap 'rm -f "$text" "$text.md"' EXIT
tee "$text"
grep -q "<!-- begin $1 -->" "$file" && grep -q "<!-- end $1 -->" "$file" || { echo "$page has no marks for $1" >&2; exit 1; }
awk -v name="$1" -v text="$text" '
    $0 == "<!-- end " name " -->" { print ""; inside = 0 }
    !inside
    $0 == "<!-- begin " name " -->" { inside = 1; print ""; while ((getline line < text) > 0) print line }
' "$file" > "$text.md"
cat "$text.md" > "$file"
