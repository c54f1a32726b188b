// hearth doctor: checks that this machine has what Hearth needs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache_spec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hearth::command
{

struct DoctorCheck
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
std::vector<DoctorCheck> runDoctorChecks(const Result<std::vector<cache::CacheSpec>>& caches);

bool allPassed(const std::vector<DoctorCheck>& checks);
std::string checksText(const std::vector<DoctorCheck>& checks);
/// Return the checks as JSON, schema hearth.doctor/1.
std::string checksJson(const std::vector<DoctorCheck>& checks);

} // namespace hearth::command
