#!/usr/bin/env bash
# Builds the site: the guide and the reference of every header of the library. It can be
# read from disk or from any web server.
#   docs/build.sh [OUTPUT]     writes OUTPUT/index.html; OUTPUT is build/docs by default
# Fails if mkdocs or Doxygen warns, if a link is broken, or if a browser would
# fetch anything from another host. Exits with 2 if a tool is missing;
# third_party/install.sh --docs installs them.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
output=${1:-$root/build/docs}
if (($# > 1)) || [[ $output == -* ]]; then
  echo "usage: $0 [OUTPUT]" >&2
  exit 2
fi
mkdir -p "$output"
output=$(cd "$output" && pwd)
cd "$root"

mathjax=/usr/share/javascript/mathjax
for tool in doxygen mkdocs "$mathjax/MathJax.js" /usr/share/mkdocs/themes/material; do
  if [[ ! -e $tool ]] && ! command -v "$tool" >/dev/null; then
    echo "build.sh: $tool is missing; third_party/install.sh --docs installs it" >&2
    exit 2
  fi
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# The reference. Everything but fields and macros needs a comment.
{
  cat docs/doxygen/Doxyfile
  printf 'PROJECT_NUMBER = %s\n' "$(sed -nE 's/^project\(quatro VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)"
  printf 'OUTPUT_DIRECTORY = "%s"\nHTML_OUTPUT = api\n' "$scratch/pages"
  printf 'WARN_LOGFILE = "%s"\n' "$scratch/warnings"
} >"$scratch/Doxyfile"
mkdir "$scratch/pages"
doxygen "$scratch/Doxyfile"
if grep -vE '\((variable|macro definition)\) of .* is not documented\.$' "$scratch/warnings" >&2; then
  echo "build.sh: Doxygen warns; see above" >&2
  exit 1
fi
rm -f "$scratch/pages/api/doxygen.svg"

# The guide goes beside the reference so that mkdocs checks the links between them.
/usr/bin/python3 docs/assemble.py "$scratch/pages"
mkdir -p "$scratch/pages/mathjax"
cp -rL --parents "$mathjax"/{MathJax.js,config/TeX-AMS_CHTML-full.js,jax/output/CommonHTML/fonts/TeX} \
    "$mathjax"/{fonts/HTML-CSS/TeX/woff,extensions/MathZoom.js,extensions/MathMenu.js} "$scratch"
mv "$scratch$mathjax"/* "$scratch/pages/mathjax"
sed "s#^docs_dir: .*#docs_dir: '$scratch/pages'#" docs/mkdocs.yml >"$scratch/mkdocs.yml"
mkdocs build --quiet --strict --config-file "$scratch/mkdocs.yml" --site-dir "$output"
rm -f "$output/sitemap.xml" "$output/sitemap.xml.gz"
/usr/bin/python3 docs/check_site.py "$output"
echo "$output/index.html"
