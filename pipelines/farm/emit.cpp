// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/emit.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace hearth::farm
{

namespace
{

constexpr uint64_t kMiB = uint64_t{1} << 20;
// memory of hearth itself beside its cookers: programs and libraries to be hashed are read in pieces
constexpr uint64_t kHearthMemory = 64 * kMiB;

std::string joinQuoted(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : " ") + quoteForShell(word);
    return text;
}

/// Return the arguments that all commands of the job share.
std::string commonWords(const FarmJob& job)
{
    std::string text;
    if (!job.directory.empty())
        text += " -C " + quoteForShell(job.directory);
    for (const std::string& cache : job.caches)
        text += " --cache " + quoteForShell(cache);
    return text;
}

/// Return the start of the command line of a shard, up to "--shard ".
std::string shardCommandStart(const FarmJob& job)
{
    return joinQuoted({job.hearth, "run", job.plan_file}) + commonWords(job) + " --shard ";
}

/// Escape text for the value of a Ninja variable.
std::string escapeNinjaValue(const std::string& text)
{
    std::string escaped;
    for (const char c : text)
        escaped += c == '$' ? "$$" : std::string(1, c);
    return escaped;
}

/// Escape a path for a build line of Ninja.
std::string escapeNinjaPath(const std::string& path)
{
    std::string escaped;
    for (const char c : path)
        escaped += (c == '$' || c == ' ' || c == ':' ? "$" : "") + std::string(1, c);
    return escaped;
}

std::string megabytes(uint64_t bytes)
{
    return fmt::format("{}M", (bytes + kMiB - 1) / kMiB);
}

/// Return the first lines of a Slurm job.
std::string slurmHead(const char* name, uint64_t memory_bytes, const SlurmOptions& options)
{
    std::string text =
        fmt::format("#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --mem={}\n", name, megabytes(memory_bytes));
    if (!options.partition.empty())
        text += "#SBATCH --partition=" + options.partition + "\n";
    return text;
}

std::string slurmShard(const FarmJob& job, const SlurmOptions& options)
{
    return slurmHead("hearth-shards", options.memory_bytes, options) +
           fmt::format("#SBATCH --array=0-{}\n#SBATCH --requeue\n", job.shard_count - 1) +
           fmt::format("code=0\n{}\"$SLURM_ARRAY_TASK_ID/{}\" --memory {} || code=$?\n",
                       shardCommandStart(job), job.shard_count, megabytes(options.memory_bytes)) +
           fmt::format("# 75: another try may go better, perhaps on another machine\n"
                       "if [ \"$code\" -eq 75 ] && [ \"${{SLURM_RESTART_COUNT:-0}}\" -lt {} ]; then\n"
                       "  scontrol requeue \"${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID\" && exit 0\n"
                       "fi\n"
                       "# a cluster may be set up to requeue 75 by itself, without end\n"
                       "[ \"$code\" -ne 75 ] || code=1\n"
                       "exit \"$code\"\n",
                       options.retries);
}

std::string slurmMerge(const FarmJob& job, const SlurmOptions& options)
{
    return slurmHead("hearth-merge", options.merge_memory_bytes, options) + "exec " + mergeCommand(job) +
           "\n";
}

uint64_t maxMemory(const graph::Graph& graph, bool of_sources)
{
    uint64_t most = 0;
    for (const graph::Action& action : graph.actions)
        if ((action.source < graph.source_count) == of_sources)
            most = std::max(most, action.estimate.memory_bytes);
    return most + kHearthMemory;
}

} // namespace

std::string quoteForShell(const std::string& word)
{
    constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./:=,+-@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos)
        return word;
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string shardCommands(const FarmJob& job)
{
    std::string text;
    for (size_t shard = 0; shard < job.shard_count; ++shard)
        text += fmt::format("{}{}/{}\n", shardCommandStart(job), shard, job.shard_count);
    return text;
}

std::string mergeCommand(const FarmJob& job)
{
    return joinQuoted({job.hearth, "merge", job.plan_file, "-o", job.pack}) + commonWords(job) +
           (job.skips_missing ? " --missing skip" : "");
}

std::string ninjaFile(const FarmJob& job, const std::string& launcher)
{
    const std::string plan = escapeNinjaPath(job.plan_file);
    const std::string launched =
        launcher.empty() ? "" : " --launcher " + escapeNinjaValue(quoteForShell(launcher));
    std::string text = fmt::format(
        "ninja_required_version = 1.5\n\n"
        "# what the launcher says is not believed: hearth run looks at what the shard has left\n"
        "rule shard\n  command = {}$shard/{}{} --record $out\n  description = shard $shard of {}\n\n"
        "rule merge\n  command = {}\n  description = merge\n  restat = 1\n\n",
        escapeNinjaValue(shardCommandStart(job)), job.shard_count, launched, job.shard_count,
        escapeNinjaValue(mergeCommand(job)));
    std::string records;
    for (size_t shard = 0; shard < job.shard_count; ++shard)
    {
        const std::string record = fmt::format("{}.shards/{}.json", plan, shard);
        text += fmt::format("build {}: shard | {}\n  shard = {}\n", record, plan, shard);
        records += " " + record;
    }
    return text + fmt::format("build {}: merge | {}{}\n", escapeNinjaPath(job.pack), plan, records);
}

std::string slurmScript(const FarmJob& job, const SlurmOptions& options)
{
    return "#!/bin/sh\nset -eu\nshards=$(sbatch --parsable <<'END_OF_SHARDS'\n" + slurmShard(job, options) +
           "END_OF_SHARDS\n)\n"
           "# after them however they end: the merge looks at results, not at exit codes\n"
           "merge=$(sbatch --parsable --dependency=\"afterany:${shards%%;*}\" <<'END_OF_MERGE'\n" +
           slurmMerge(job, options) +
           "END_OF_MERGE\n)\n"
           "echo \"shards: job ${shards%%;*}\"\necho \"merge: job ${merge%%;*}\"\n";
}

uint64_t shardMemory(const graph::Graph& graph)
{
    return maxMemory(graph, true);
}

uint64_t mergeMemory(const graph::Graph& graph)
{
    // the merge cooks the results that shards have not delivered
    return std::max(maxMemory(graph, true), maxMemory(graph, false));
}

} // namespace hearth::farm
