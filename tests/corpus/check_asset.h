// Cooks one asset as a user would, checks the pack or the error, and compares the outcome with the asset's
// class; writes packs as GLB, and wraps what these have.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/corpus/manifest.h"
#include "tests/corpus/opened_files.h"

#include <string>
#include <vector>

namespace hearth::corpus
{

struct Programs
{
    std::string hearth; ///< absolute path
    std::string import; ///< hearth-import's absolute path
    std::string render; ///< absolute path; empty: packs are not rendered
    std::string wrap;   ///< absolute path; empty: nothing is wrapped
    AllowedFiles allowed;
};

/// Outcome of a cook, independent of the asset's class.
enum class Outcome
{
    loads,   ///< a valid pack
    rejects, ///< one clear error and no output
    broken,  ///< anything else
};
const char* outcomeName(Outcome outcome);

struct Finding
{
    Outcome outcome = Outcome::broken;
    std::vector<std::string> faults; ///< one sentence each; none if the class's requirements are met
    int exit_code = 0;
    std::vector<std::string> messages; ///< the most informative lines that the cook wrote to stderr
    double cook_seconds = 0;
    double total_seconds = 0; ///< including all that is done with the pack
    uint64_t peak_rss_bytes = 0;
};

/// Cook `asset` in `work`, an empty folder that the function fills and empties again.
Finding checkAsset(const Asset& asset, const Programs& programs, const std::string& work);

/// Return the files that the programs open outside of the asset's folder, their own folder and `work` while
/// they cook `asset`, a trusted asset.
std::set<std::string> traceSystemFiles(const Asset& asset, const Programs& programs, const std::string& work);

} // namespace hearth::corpus
