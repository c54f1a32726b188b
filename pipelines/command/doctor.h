// hearth doctor: checks that this machine has what Hearth needs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/open_cache.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::command
{

struct Check
{
    enum class State : uint8_t
    {
        ok,
        warning, ///< Hearth works, but less well
        wrong,
    };
    std::string name; ///< "programs", "cache", "device", ...
    State state = State::ok;
    std::string text;
    std::string remedy; ///< what to do; empty if the state is ok
};

/// Run all checks.
/// caches  caches of the configuration, or the error in how they were named
std::vector<Check> examine(const Result<std::vector<cache::LevelSpec>>& caches);

bool isWell(const std::vector<Check>& checks);
std::string checksText(const std::vector<Check>& checks);
/// Return the checks as JSON, schema hearth.doctor/1.
std::string checksJson(const std::vector<Check>& checks);

} // namespace hearth::command
