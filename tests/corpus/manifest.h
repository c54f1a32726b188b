// Reads the list of test assets: the kind of each file, and the required outcome of its cook.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "tests/corpus/run_process.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::corpus
{

/// Outcomes that an `expected` class of the manifest allows.
struct AssetClass
{
    std::string_view name;
    bool may_load = false;
    bool may_reject = false;

    /// Only a pack is acceptable: its counts are compared and it is rendered.
    bool mustLoad() const { return may_load && !may_reject; }
};

inline constexpr AssetClass kAssetClasses[] = {
    {"must-load", true, false},
    {"must-load-with-warnings", true, false},
    {"load-or-clear-texture-warning", true, false}, // the geometry must cook; only the texture may be dropped
    {"load-or-clear-error", true, true},
    {"load-or-clear-unsupported-error", true, true},
    {"must-not-crash", true, true},
    {"must-reject", false, true},
};

/// Confidence of the manifest in a class. Classes of valid files are certain.
enum class Confidence
{
    good,
    high,
    medium,
};
const char* confidenceName(Confidence confidence);

struct Asset
{
    std::string file;   ///< as the manifest and the reports name it
    std::string path;   ///< absolute
    std::string folder; ///< absolute; nothing outside of it may be read
    std::string category;
    const AssetClass* expected = nullptr;
    Confidence confidence = Confidence::good;
    Limits limits;
    uint64_t bytes = 0;
    bool self_contained = false;            ///< one file without references to others
    std::map<std::string, uint64_t> counts; ///< counts of the manifest that are integers
};

/// Read all assets in the order of `folder`/manifest.json: the valid files, then the bad.
/// errors     input_missing, json_syntax, gltf_value (an unknown class), with the manifest's path
Result<std::vector<Asset>> readManifest(const std::string& folder);

} // namespace hearth::corpus
