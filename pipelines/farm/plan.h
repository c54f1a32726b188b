// Plan of a distributed cook, as a file for machines: sources with their hashes, cookers with their versions,
// and shards.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/farm/measurements.h"
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

// Upper limits of an estimate, beyond any machine. The executor adds estimates up.
inline constexpr uint64_t kMaxBytes = uint64_t{1} << 50;
inline constexpr double kMaxSeconds = 1e9;

struct Plan
{
    Request request;
    graph::CookSettings settings; ///< made from `request`
    std::string folder;           ///< absolute; base of relative paths
    graph::Graph graph;           ///< graph of the settings, with the estimates of planning time
    /// graph::processorClass() of the planning machine, where an action depends on it; else empty
    std::string processor;
    std::map<std::string, std::string> version_of_cooker; ///< graph::cookerVersion
    std::map<std::string, std::string> hash_of_file;      ///< SHA-256 of each declared input, by path
    /// files known to be found by cookers, by action: "found ROLE/NAME"
    std::map<size_t, graph::Record> found_of_action;
    Shards shards; ///< each source is in exactly one shard
};

/// Options for the distribution of sources to shards.
struct ShardingOptions
{
    std::optional<size_t> shard_count; ///< nullopt: chooseShardCount()
    Measurements measured;             ///< overrides estimates
};

/// Make a plan.
/// programs  folder of the cookers
/// errors    those of the request's settings; input_missing, for the first input that cannot be read;
///           plan_build, where a cooker is missing
Result<Plan> makePlan(const Request& request, const std::string& folder, const ShardingOptions& sharding,
                      const std::string& programs, graph::ActionCache& actions, graph::FileHashes& hashes);

/// Check that this machine matches the plan, as far as these sources need it: cookers, processor, contents of
/// files.
/// errors  plan_build, plan_processor, plan_stale, input_missing
Status checkPlan(const Plan& plan, const std::vector<size_t>& sources, const std::string& programs,
                 graph::ActionCache& actions, graph::FileHashes& hashes);

/// Serialize a plan, schema "hearth.plan/1": the graph as graph::planJson writes it, and the members for
/// farms. Equal plans give equal bytes.
std::string planText(const Plan& plan);

/// Parse a plan from an untrusted source. Every member must be known, of its type and in range, and the graph
/// must be the one that `hearth cook` would make of the request, word by word. So even a forged plan can run
/// no program but Hearth's cookers, with command lines that `hearth cook` could give them; the executor
/// chooses where they write.
/// errors  json_syntax, plan_syntax; they name `file`
Result<Plan> parsePlan(std::string_view text, const std::string& file);

} // namespace hearth::farm
