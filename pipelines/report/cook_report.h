// What became of a cook: the report, schema "hearth.report/1" (pipelines/schemas/hearth.report.1.json).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/executor.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::report
{

/// When an action ran.
struct ActionTime
{
    double start_seconds = 0; ///< since the cook began
    unsigned lane = 0;        ///< no two that run at once have the same; the least that is free
};

struct CookReport
{
    std::vector<std::string> sources;
    std::string output;
    std::string started; ///< UTC, ISO 8601
    int exit_code = 0;
    double seconds = 0;
    bool is_up_to_date = false; ///< the pack was there already, byte for byte
    uint64_t output_bytes = 0;
    std::string error; ///< the first error line; empty where there is none

    /// null: the cook ended before there was one, and all that is below is empty
    const graph::Graph* graph = nullptr;
    std::vector<graph::ActionOutcome> outcomes;    ///< of its actions
    std::map<size_t, ActionTime> times;            ///< of actions that ran
    std::map<size_t, std::string> errors;          ///< error lines of actions that failed
    std::map<size_t, std::string> source_warnings; ///< by source: warning lines of the cook as a whole
    std::map<size_t, std::string> statistics;      ///< JSON that actions have written beside their parts
    std::map<size_t, std::string> pictures;        ///< PNG, of visibilities
    /// Bytes of the pack by the types of its chunks, as they lie in the file; empty where there is none.
    std::map<std::string, uint64_t> bytes_of_chunks;
};

std::string reportJson(const CookReport& cook);

} // namespace hearth::report
