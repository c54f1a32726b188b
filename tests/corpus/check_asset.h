// Cooks one asset as a user would, checks the pack or the refusal, and says whether it is what its class asks for.
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
    std::string render; ///< absolute path; empty: packs are not drawn
    AllowedFiles allowed;
};

/// How a cook came out, whatever its class asks for.
enum class Outcome
{
    loads,   ///< a sound pack
    rejects, ///< one clear error and no output
    broken,  ///< anything else
};
const char* outcomeName(Outcome outcome);

struct Finding
{
    Outcome outcome = Outcome::broken;
    std::vector<std::string> faults; ///< one sentence each; none where the class is met
    int exit_code = 0;
    std::vector<std::string> messages; ///< the most telling lines that the cook wrote to stderr
    double cook_seconds = 0;
    double total_seconds = 0; ///< with verify, inspect and drawing
    uint64_t peak_rss_bytes = 0;
};

/// Cook `asset` in `work`, an empty folder that this fills and empties again.
Finding checkAsset(const Asset& asset, const Programs& programs, const std::string& work);

/// The files that the programs open outside the asset's folder, their own and `work` when they cook `asset`, which is
/// one that they can be trusted with.
std::set<std::string> systemFilesOf(const Asset& asset, const Programs& programs, const std::string& work);

} // namespace hearth::corpus
