// Report of a cook, schema "hearth.report/1" (pipelines/schemas/hearth.report.1.json).
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

/// Time and lane of an action in the timeline.
struct ActionTime
{
    double start_seconds = 0; ///< since the cook began
    unsigned lane = 0;        ///< lowest free lane; concurrent actions have different lanes
};

struct CookReport
{
    std::vector<std::string> sources;
    std::string output;
    std::string started; ///< UTC, ISO 8601
    int exit_code = 0;
    double seconds = 0;
    bool is_up_to_date = false; ///< the destination had the same pack already, byte for byte
    uint64_t output_bytes = 0;
    std::string error; ///< the first error line; empty where there is none
    /// True if the pack is at its destination; exit_code is not 0 if it lacks sources.
    bool has_pack = false;
    std::vector<size_t> skipped; ///< sources that the pack lacks, ascending; empty where there is no pack

    /// null: the cook ended before a graph was made, and all members below are empty
    const graph::Graph* graph = nullptr;
    std::vector<graph::ActionOutcome> outcomes;    ///< [graph->actions.size()]
    std::map<size_t, ActionTime> times;            ///< by action, for actions that ran
    std::map<size_t, std::string> errors;          ///< error lines by action, for actions that failed
    std::map<size_t, std::string> source_warnings; ///< warning lines about the whole cook, by source
    std::map<size_t, std::string> statistics;      ///< JSON that actions wrote beside their parts, by action
    std::map<size_t, std::string> images;          ///< PNG of baked visibility, by action
    /// Bytes of the pack by chunk type, as stored in the file; empty where there is no pack.
    std::map<uint32_t, uint64_t> bytes_of_chunks;
};

std::string reportJson(const CookReport& cook);

} // namespace hearth::report
