// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/farm/emit.h"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>
#include <utility>

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

/// Return the steps of the job's shards, in order.
std::vector<Step> listSteps(const FarmJob& job)
{
    return job.has_two_steps ? std::vector{Step::prepare, Step::complete} : std::vector{Step::complete};
}

/// Return the start of the command line of a shard, up to "--shard ".
std::string shardCommandStart(const FarmJob& job, Step step)
{
    return joinQuoted({job.hearth, "run", job.plan_file}) + (step == Step::prepare ? " --prepare" : "") +
           commonWords(job) + " --shard ";
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

/// Return the name of the Ninja rule of a step.
const char* ninjaRule(Step step)
{
    return step == Step::prepare ? "prepare" : "shard";
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

std::string slurmShard(const FarmJob& job, Step step, const SlurmOptions& options)
{
    return slurmHead(step == Step::prepare ? "hearth-prepare" : "hearth-shards", options.memory_bytes,
                     options) +
           fmt::format("#SBATCH --array=0-{}\n#SBATCH --requeue\n", job.shard_count - 1) +
           fmt::format("code=0\n{}\"$SLURM_ARRAY_TASK_ID/{}\" --memory {} || code=$?\n",
                       shardCommandStart(job, step), job.shard_count, megabytes(options.memory_bytes)) +
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
    for (const Step step : listSteps(job))
        for (size_t shard = 0; shard < job.shard_count; ++shard)
            text += fmt::format("{}{}/{}\n", shardCommandStart(job, step), shard, job.shard_count);
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
    std::string text =
        "ninja_required_version = 1.5\n\n"
        "# what the launcher says is not believed: hearth run looks at what the shard has left\n";
    for (const Step step : listSteps(job))
        text += fmt::format(
            "rule {0}\n  command = {1}$shard/{2}{3} --record $out\n  description = {0} $shard of {2}\n\n",
            ninjaRule(step), escapeNinjaValue(shardCommandStart(job, step)), job.shard_count, launched);
    text += fmt::format("rule merge\n  command = {}\n  description = merge\n  restat = 1\n\n",
                        escapeNinjaValue(mergeCommand(job)));
    std::string records, records_before;
    for (const Step step : listSteps(job))
    {
        records_before = std::exchange(records, "");
        for (size_t shard = 0; shard < job.shard_count; ++shard)
        {
            const std::string record =
                fmt::format("{}.shards/{}.{}json", plan, shard, step == Step::prepare ? "prepared." : "");
            text += fmt::format("build {}: {} | {}{}\n  shard = {}\n", record, ninjaRule(step), plan,
                                records_before.empty() ? "" : " ||" + records_before, shard);
            records += " " + record;
        }
    }
    return text + fmt::format("build {}: merge | {}{}\n", escapeNinjaPath(job.pack), plan, records);
}

std::string slurmScript(const FarmJob& job, const SlurmOptions& options)
{
    std::string text = "#!/bin/sh\nset -eu\n";
    if (job.has_two_steps)
        text += "prepare=$(sbatch --parsable <<'END_OF_PREPARE'\n" + slurmShard(job, Step::prepare, options) +
                "END_OF_PREPARE\n)\n";
    text += fmt::format("shards=$(sbatch --parsable{} <<'END_OF_SHARDS'\n",
                        job.has_two_steps ? " --dependency=\"afterany:${prepare%%;*}\"" : "") +
            slurmShard(job, Step::complete, options) +
            "END_OF_SHARDS\n)\n"
            "# after them however they end: the merge looks at results, not at exit codes\n"
            "merge=$(sbatch --parsable --dependency=\"afterany:${shards%%;*}\" <<'END_OF_MERGE'\n" +
            slurmMerge(job, options) + "END_OF_MERGE\n)\n";
    if (job.has_two_steps)
        text += "echo \"prepare: job ${prepare%%;*}\"\n";
    return text + "echo \"shards: job ${shards%%;*}\"\necho \"merge: job ${merge%%;*}\"\n";
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
