// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/cook_folder.h"

#include "tests/support/small_parts.h"

#include <filesystem>

namespace hearth::test
{

namespace
{

// Script in place of hearth-import. The source's name selects what it does.
constexpr const char* kImport = R"(#!/bin/sh
case "$1" in
  *malformed*) echo "$1|/meshes/0: error: is bad [E1101] hint: mend it" >&2; exit 65 ;;
  *missing*) echo "$1: error: cannot open [E1001] hint: look" >&2; exit 66 ;;
  *echoed*) echo "$*" >> asked ;;
  *silent*) exit 65 ;;
  *strange*) echo "terminate called" >&2; exit 1 ;;
  *crash*) echo "contract broken" >&2; kill -SEGV $$ ;;
  *killed*) kill -KILL $$ ;;
  *slow*) exec sleep 60 ;;
  *busy*) mkdir busy 2>/dev/null || touch together; sleep 0.3; rmdir busy 2>/dev/null ;;
  *warning*) echo "$1|/extras: warning: left out [W1400]" >&2; echo "noise of a library" >&2 ;;
esac
cp "PARTS.import.part" "$3"
case "$1" in *halfway*) echo "halfway" > "$3" ;; esac
while [ $# -gt 0 ]; do if [ "$1" = "--stats" ]; then cp "PARTS.import.json" "$2"; fi; shift; done
)";

constexpr const char* kTextures = R"(#!/bin/sh
if grep -q "^halfway" "$1"; then echo "$1|chunk IMGD 0: error: is bad [E2009] hint: again" >&2; exit 65; fi
if [ -e ./textures-fail ]; then echo "$1|chunk IMGD 0: error: is bad [E2009] hint: again" >&2; exit 65; fi
cp "PARTS.textures.part" "$3"
while [ "$1" != "--stats" ]; do shift; done
echo '{"images": [{"name": "bark", "width": 4, "height": 2, "mips": 3, "format": "rgba8-srgb", "bytes": 44,
                   "bytes_stored": 40, "error": {"rms": 0.0, "psnr_db": null}}]}' > "$2"
)";

constexpr const char* kTexels = R"(#!/bin/sh
cp "PARTS.textures.part" "$4"
while [ "$1" != "--stats" ]; do shift; done
echo '{"images": [{"format": "astc-6x6-srgb", "role": "color", "bytes": 48, "bytes_stored": 30,
                   "error": {"rms": 0.01, "psnr_db": 40.0}, "error_p999": {"rms": 0.02, "psnr_db": 34.0},
                   "error_smooth": {"rms": 0.0, "psnr_db": null}, "coverage_error": 0.0,
                   "target": {"rms": 0.015, "psnr_db": 36.5}, "holds_target": true}]}' > "$2"
while [ $# -gt 0 ]; do if [ "$1" = "--image" ]; then : > "$2"; fi; shift; done
)";

constexpr const char* kClusters = R"(#!/bin/sh
if [ "$4" = "--set" ]; then echo "$*" >> asked; fi
if grep -q "^halfway" "$1"; then echo "$1|chunk SMSH 0: error: is bad [E2010] hint: again" >&2; exit 65; fi
if [ -e ./clusters-lie ]; then exit 0; fi
cp "PARTS.clusters.part" "$3"
while [ "$1" != "--stats" ]; do shift; done
echo '{"meshes": [{"name": "strip", "source": {"triangles": 8}, "levels": [], "clusters": 1,
                   "bytes": {"pages_stored": 70}}], "totals": {"triangles": 8}}' > "$2"
)";

constexpr const char* kSkinning = R"(#!/bin/sh
cp "PARTS.skinning.part" "$4"
)";

constexpr const char* kBricks = R"(#!/bin/sh
case "$*" in
  *"--voxel-size 7"*) echo "--voxel-size: error: is bad [E1000] hint: another" >&2; exit 2 ;;
  *"--memory 4096"*) echo "$5: warning: too little [W1400]" >&2 ;;
esac
while [ $# -gt 0 ]; do
  case "$1" in
    -o) cp "PARTS.bricks.part" "$2" ;;
    --stats) echo '{"voxel_size": 0.5}' > "$2" ;;
  esac
  shift
done
)";

std::string withParts(std::string script, const std::string& parts)
{
    replaceAll(script, "PARTS", parts);
    return script;
}

} // namespace

Cook::Cook()
{
    PackModel model = smallPack();
    model.meta = importMeta("small.gltf");
    writeParts(model, programs.path(), "small");
    const std::string parts = programs / "small";
    programs.write("small.import.json", model.meta);
    programs.write("hearth-import", withParts(kImport, parts), true);
    programs.write("hearth-textures", withParts(kTextures, parts), true);
    programs.write("hearth-texels", withParts(kTexels, parts), true);
    programs.write("hearth-clusters", withParts(kClusters, parts), true);
    programs.write("hearth-skinning", withParts(kSkinning, parts), true);
    programs.write("hearth-bricks", withParts(kBricks, parts), true);
    model.bricks.reflectors.clear(); // the pack may have other lights than the model
    writeBricksPart(model, parts + ".bricks.part");
    std::filesystem::copy(HEARTH_BIN "/hearth", programs / "hearth");
    std::filesystem::copy(HEARTH_BIN "/hearth-link", programs / "hearth-link");
}

void Cook::expectFailure(const ProgramEnd& end, int exit_code, const std::string& part_of_message)
{
    EXPECT_EQ(end.exit_code, exit_code) << end.err;
    EXPECT_EQ(countOccurrences(end.err, ": error: "), 1u) << end.err;
    EXPECT_EQ(end.out, "");
    EXPECT_NE(end.err.find(part_of_message), std::string::npos) << end.err;
    EXPECT_EQ(folder.list(), std::vector<std::string>{}) << end.err;
}

} // namespace hearth::test
