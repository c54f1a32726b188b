// Cooks samples with the real programs, step by step, for tests that load and draw them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pack.h"
#include "tests/reference/pack_geometry.h"

#include <string>
#include <vector>

namespace hearth::roundtrip
{

/// Result of a program run.
struct ProgramEnd
{
    int exit_code = -1; ///< -1 if it did not exit by itself
    std::string output; ///< stdout
    std::string errors; ///< stderr
};

/// The programs of the build.
enum class Program
{
    samples,
    import,
    clusters,
    textures,
    skinning,
    link,
    hearth,
    render,
};

ProgramEnd runProgram(Program program, const std::vector<std::string>& arguments);
/// Run another program, by its path.
ProgramEnd runProgram(const std::string& program, const std::vector<std::string>& arguments);

/// A folder that is removed with its content when the object is destroyed.
class ScratchFolder
{
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    std::string path(const std::string& name) const { return folder_ + "/" + name; }

private:
    std::string folder_;
};

struct SampleSpec
{
    std::string kind;
    uint64_t triangles = 0; ///< 0: the kind's own default
    uint32_t texture_size = 64;
};

/// A sample as import part and as pack. All test programs of a build share it: the first one that needs it
/// cooks it, the others wait. Stops the test program if a step fails: later results would be meaningless.
class CookedSample
{
public:
    explicit CookedSample(const SampleSpec& spec);

    const formats::PackView& pack() const { return pack_->view(); }
    const reference::PackGeometry& geometry() const { return *geometry_; }
    const formats::PackView& importPart() const { return *import_part_; }
    const std::string& packPath() const { return pack_path_; }

private:
    std::string pack_path_;
    std::unique_ptr<pack::Pack> pack_;
    std::unique_ptr<reference::PackGeometry> geometry_;
    std::unique_ptr<formats::PackView> import_part_;
};

/// Sample of that spec, opened at first use and cached until the program ends.
const CookedSample& cookedSample(const SampleSpec& spec);

} // namespace hearth::roundtrip
