// A cook as a file that machines can be given: what is cooked, from which contents, by which cookers, and where.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/farm/measured.h"
#include "pipelines/farm/request.h"
#include "pipelines/farm/shards.h"
#include "pipelines/graph/action_cache.h"
#include "pipelines/graph/cook_graph.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::farm
{

// Of an estimate: more memory or time than any machine has. The executor adds estimates up.
inline constexpr uint64_t kMostBytes = uint64_t{1} << 50;
inline constexpr double kMostSeconds = 1e9;

struct Plan
{
    Request request;
    graph::CookSettings settings; ///< of the request
    std::string folder;           ///< absolute; relative paths start there
    graph::Graph graph;           ///< of the settings, estimates as they were planned
    std::string
        processor; ///< graph::processorClass() of who planned, where an action depends on it; else empty
    std::map<std::string, std::string> version_of_cooker; ///< graph::cookerVersion
    std::map<std::string, std::string> hash_of_file;      ///< SHA-256 of every declared input, by its path
    std::map<size_t, graph::Record>
        found_of_action; ///< what was known to be found by cookers: "found ROLE/NAME"
    Shards shards;       ///< each source is in one
};

/// How sources shall be shared out.
struct Sharing
{
    std::optional<size_t> shard_count; ///< nothing: as shardCountFor says
    Measured measured;                 ///< goes over estimates
};

/// programs  folder of the cookers
/// errors    what the request asks for is wrong; input_missing, for the first input that cannot be read; plan_build, where
///           a cooker is missing
Result<Plan> makePlan(const Request& request, const std::string& folder, const Sharing& sharing,
                      const std::string& programs, graph::ActionCache& actions, graph::FileHashes& hashes);

/// Whether what is here is what was planned, as far as these sources need it: cookers, processor, contents of files.
/// errors  plan_build, plan_processor, plan_stale, input_missing
Status checkPlan(const Plan& plan, const std::vector<size_t>& sources, const std::string& programs,
                 graph::ActionCache& actions, graph::FileHashes& hashes);

/// Schema "hearth.plan/1": the graph as graph::planJson writes it, and what a farm needs beside it. The same plan gives the
/// same bytes.
std::string planText(const Plan& plan);

/// Take nothing on trust: every member is known, of its type and in range, and the graph is the one that `hearth cook` would
/// make of the request, word by word. So whoever wrote the plan, no program runs but Hearth's cookers, with such command
/// lines as `hearth cook` gives them; they write where their executor says.
/// errors  json_syntax, plan_syntax; they name `file`
Result<Plan> parsePlan(std::string_view text, const std::string& file);

} // namespace hearth::farm
