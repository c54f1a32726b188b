#!/usr/bin/env bash
# list_licences.sh FOLDER LIBRARY: prints, as the table of docs/LICENCES.md, which shared libraries the programs in FOLDER and the
# runtime LIBRARY load, with their licences as Debian 12 states them. Fails at a library that it does not know.
set -euo pipefail
folder=$1 runtime=$2

# start of a library's name, project, licence; the first line that matches counts
known='
ld-linux|-|-
libc.so|-|-
libm.so|-|-
libgcc_s|-|-
libstdc++|-|-
libzstd|Zstandard|BSD-3-Clause
libxxhash|xxHash|BSD-2-Clause
libfmt|fmt|MIT
libgmp|GMP|LGPL-3.0-or-later
libmpfr|MPFR|LGPL-3.0-or-later
libcrypto|OpenSSL|Apache-2.0
libtbb|oneTBB|Apache-2.0
libOpenMesh|OpenMesh|BSD-3-Clause
libembree|Embree|Apache-2.0
libpng|libpng|libpng-2.0
libz.so|zlib|Zlib
libjpeg|libjpeg-turbo|IJG and BSD-3-Clause
libwebp|libwebp|BSD-3-Clause
libOpenImageIO|OpenImageIO with FFmpeg|BSD-3-Clause and GPL-2.0-or-later
liblcms2|Little CMS|MIT
libOpenEXR|OpenEXR|BSD-3-Clause
libIex|OpenEXR|BSD-3-Clause
libIlmThread|OpenEXR|BSD-3-Clause
libImath|Imath|BSD-3-Clause
libmeshoptimizer|meshoptimizer|MIT
libdraco|Draco|Apache-2.0
libastcenc|astcenc|Apache-2.0
libglog|glog|BSD-3-Clause
libgflags|gflags|BSD-3-Clause
libspqr|SuiteSparse SPQR|GPL-2.0-or-later
libcholmod|SuiteSparse CHOLMOD|LGPL-2.1-or-later and GPL-2.0-or-later
libcxsparse|SuiteSparse CXSparse|LGPL-2.1-or-later
libamd|SuiteSparse orderings|BSD-3-Clause
libcamd|SuiteSparse orderings|BSD-3-Clause
libcolamd|SuiteSparse orderings|BSD-3-Clause
libccolamd|SuiteSparse orderings|BSD-3-Clause
libsuitesparseconfig|SuiteSparse orderings|BSD-3-Clause
liblapack|BLAS and LAPACK|BSD-3-Clause
libblas|BLAS and LAPACK|BSD-3-Clause
libf77blas|BLAS and LAPACK|BSD-3-Clause
libatlas|BLAS and LAPACK|BSD-3-Clause
libopenblas|BLAS and LAPACK|BSD-3-Clause
libstb|stb|MIT
libSDL2|SDL|Zlib
libvulkan|Vulkan loader|Apache-2.0
'

echo '| program | shared libraries | GPL |'
echo '|---|---|---|'
for file in "$folder"/hearth "$folder"/hearth-* "$runtime"; do
  name=$(basename "$file")
  [[ $name != hearth-reference ]] || continue # for tests alone
  libraries=$(LC_ALL=C readelf -d "$file" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' | awk -v known="$known" -v file="$name" '
    BEGIN { count = split(known, lines, "\n") }
    {
      for (i = 1; i <= count; ++i) {
        split(lines[i], field, "|")
        if (field[1] != "" && index($0, field[1]) == 1) break
      }
      if (i > count) { print file " loads " $0 ", whose licence is not listed" > "/dev/stderr"; exit 1 }
      if (field[2] != "-") print field[2] " (" field[3] ")"
    }' | LC_ALL=C sort -u)
  gpl=no
  [[ $name != hearth-wrap ]] || gpl=**yes** # CGAL has no shared library
  ! grep -q '[( ]GPL' <<<"$libraries" || gpl=**yes**
  echo "| \`${name%%.so*}\` | ${libraries//$'\n'/, } | $gpl |"
done
