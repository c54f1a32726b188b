// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook.h"

#include "cook/tools/child_processes.h"
#include "cook/tools/lod_files.h"
#include "cook/tools/private_folder.h"
#include "cook/tools/whole_file.h"
#include "formats/pack_view.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>

namespace hearth::command
{

using namespace tools;

namespace
{

constexpr int kInterrupted = 130;

/// One cooker to run; the plan is a list of them, each after those that it reads from.
struct Stage
{
    std::string name;
    size_t source = 0;
    std::vector<std::string> command;
    std::string output;
    std::vector<size_t> after;
    std::string subject; ///< what messages call its output: the source, or the pack
    enum class State
    {
        waiting,
        running,
        done
    } state = State::waiting;
};

using Plan = std::vector<Stage>;

// ---- plan

/// What hearth-clusters says of a source.
std::string statisticsFile(const std::string& folder, size_t index)
{
    return fmt::format("{}/{}.clusters.json", folder, index);
}

/// What hearth-bricks says of all sources.
std::string brickStatisticsFile(const std::string& folder)
{
    return folder + "/bricks.json";
}

/// The flags of hearth-visibility.
std::vector<std::string> visibilityFlags(const VisibilityOptions& options)
{
    std::vector<std::string> flags{"--quality", options.quality, "--occluders", options.occluders};
    if (options.distance > 0)
        flags.insert(flags.end(), {"--distance", fmt::format("{}", options.distance), "--power",
                                   fmt::format("{}", options.power)});
    return flags;
}

/// Appends the source's stages; returns those whose parts the link reads, in this order: import, clusters, textures,
/// skinning.
std::vector<size_t> addSource(Plan& plan, const std::string& programs, const std::string& folder,
                              size_t index, const CookOptions& options)
{
    const std::string& source = options.sources[index];
    const auto part = [&](const std::string& kind)
    { return fmt::format("{}/{}.{}.part", folder, index, kind); };
    /// Runs hearth-`kind` over the parts of stages before.
    const auto add = [&](const std::string& kind, const std::vector<size_t>& inputs)
    {
        Stage stage{kind, index, {programs + "/hearth-" + kind}, part(kind), inputs, source};
        for (const size_t input : inputs)
            stage.command.push_back(plan[input].output);
        stage.command.insert(stage.command.end(), {"-o", stage.output});
        plan.push_back(std::move(stage));
        return plan.size() - 1;
    };
    const auto addFlags = [&](size_t stage, const std::vector<std::string>& flags)
    { plan[stage].command.insert(plan[stage].command.end(), flags.begin(), flags.end()); };

    const size_t import_stage = add("import", {});
    plan[import_stage].command.insert(plan[import_stage].command.begin() + 1, source);
    for (const std::string& lod : options.lods)
        addFlags(import_stage, {"--lod", lod});
    const size_t textures = add("textures", {import_stage});
    const size_t clusters = add("clusters", {import_stage});
    if (!options.profile.empty())
        for (const size_t stage : {import_stage, clusters})
            addFlags(stage, {"--profile", options.profile});
    if (!options.report_file.empty())
        addFlags(clusters, {"--stats", statisticsFile(folder, index)});
    const size_t skinning = add("skinning", {import_stage, clusters});
    if (!options.visibility)
        return {import_stage, clusters, textures, skinning};
    addFlags(clusters, {"--visibility"});
    const size_t visibility = add("visibility", {import_stage, clusters});
    addFlags(visibility, visibilityFlags(*options.visibility));
    return {import_stage, visibility, textures, skinning};
}

/// The table that shading needs beside visibilities; no source has a say in it.
std::string addSpecular(Plan& plan, const std::string& programs, const std::string& folder,
                        const CookOptions& options)
{
    const std::string part = folder + "/specular.part";
    plan.push_back({"specular",
                    options.sources.size(),
                    {programs + "/hearth-specular", "-o", part},
                    part,
                    {},
                    options.output});
    return part;
}

/// The grid of all sources' scenes.
std::string addBricks(Plan& plan, const std::string& programs, const std::string& folder,
                      const CookOptions& options)
{
    const std::string part = folder + "/bricks.part";
    Stage stage{"bricks", options.sources.size(), {programs + "/hearth-bricks"}, part, {}, options.output};
    for (size_t source = 0; source < options.sources.size(); ++source)
        for (const char* kind : {"import", "clusters", "textures"})
            for (size_t i = 0; i < plan.size(); ++i)
                if (plan[i].source == source && plan[i].name == kind)
                {
                    stage.command.push_back(plan[i].output);
                    stage.after.push_back(i);
                }
    stage.command.insert(stage.command.end(), {"-o", part});
    if (options.bricks->voxel_size)
        stage.command.insert(stage.command.end(),
                             {"--voxel-size", fmt::format("{}", *options.bricks->voxel_size)});
    if (options.bricks->memory_bytes)
        stage.command.insert(stage.command.end(),
                             {"--memory", fmt::format("{}", *options.bricks->memory_bytes)});
    if (!options.report_file.empty())
        stage.command.insert(stage.command.end(), {"--stats", brickStatisticsFile(folder)});
    plan.push_back(std::move(stage));
    return part;
}

/// inputs  stages whose parts the link reads, in this order
void addLink(Plan& plan, const std::string& programs, const std::string& folder, const std::string& packed,
             const std::vector<size_t>& inputs, const CookOptions& options)
{
    Stage link{"link", options.sources.size(), {programs + "/hearth-link"}, packed, {}, options.output};
    for (const size_t input : inputs)
        link.command.push_back(plan[input].output);
    if (options.visibility)
        link.command.insert(link.command.end(), {"--specular", addSpecular(plan, programs, folder, options)});
    if (options.bricks)
        link.command.insert(link.command.end(), {"--bricks", addBricks(plan, programs, folder, options)});
    link.command.insert(link.command.end(), {"-o", packed});
    for (size_t i = 0; i < plan.size(); ++i)
        link.after.push_back(i);
    plan.push_back(std::move(link));
}

// ---- messages

/// What a child says names parts in private folders; the user knows the source.
std::string inUsersWords(std::string text, const Plan& plan)
{
    for (const Stage& stage : plan)
        for (size_t at = text.find(stage.output); at != std::string::npos; at = text.find(stage.output, at))
        {
            text.replace(at, stage.output.size(), stage.subject);
            at += stage.subject.size();
        }
    return text;
}

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    for (size_t at = 0; at < text.size();)
    {
        const size_t end = std::min(text.find('\n', at), text.size());
        if (end > at)
            lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

bool isError(const std::string& line)
{
    return line.find("error: ") != std::string::npos && line.find(" [E") != std::string::npos;
}

bool isWarning(const std::string& line)
{
    return line.find("warning: ") != std::string::npos && line.find(" [W") != std::string::npos;
}

void print(const std::string& line)
{
    std::fprintf(stderr, "%s\n", line.c_str());
}

/// Pass on a child's messages: errors always, the noise of libraries only when everything is asked for.
void passOn(const std::vector<std::string>& lines, Verbosity verbosity)
{
    for (const std::string& line : lines)
        if (isError(line) || (isWarning(line) && verbosity != Verbosity::quiet) ||
            verbosity == Verbosity::all)
            print(line);
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : " ") + word;
    return text;
}

// ---- failures

struct Failure
{
    int exit_code = 0;
    std::string error;
    size_t source = 0;
};

/// The exit codes by which a cooker says what is wrong; any other is a defect.
bool isClearCode(int code)
{
    return code == 2 || code == 65 || code == 66 || code == 70 || code == 73 || code == 74;
}

/// Tell of a child that did not end as cookers do; its last words help to find the defect.
Failure crashed(const Stage& stage, const ChildEnd& end, const std::vector<std::string>& lines)
{
    std::string how = "hearth-" + stage.name;
    if (end.signal == SIGKILL)
        how += " was killed: perhaps the memory is full";
    else if (end.signal != 0)
        how += fmt::format(" was ended by signal {} ({})", end.signal, ::strsignal(end.signal));
    else
        how += fmt::format(" ended with code {} and no error message", end.exit_code);
    if (!lines.empty())
        how += ": " + lines.back();
    const Error error{Issue::child_failed, stage.subject, "", how};
    const std::string message = formatMessage(error);
    print(message);
    return {exitCode(error), message, stage.source};
}

std::optional<Failure> failureOf(const Stage& stage, const ChildEnd& end,
                                 const std::vector<std::string>& lines)
{
    const auto error = std::find_if(lines.begin(), lines.end(), isError);
    if (end.signal == 0 && isClearCode(end.exit_code) && error != lines.end())
        return Failure{end.exit_code, *error, stage.source};
    if (end.signal != 0 || end.exit_code != 0)
        return crashed(stage, end, lines);
    return std::nullopt;
}

Failure failureOf(const Error& error, size_t source)
{
    const std::string message = formatMessage(error);
    print(message);
    return {exitCode(error), message, source};
}

// ---- run

uint64_t sizeOf(const std::string& path)
{
    std::error_code error;
    const uintmax_t size = std::filesystem::file_size(path, error);
    return error ? 0 : size;
}

void printStage(const CookOptions& options, const Stage& stage, const StageRecord& record)
{
    if (options.verbosity != Verbosity::quiet)
        print(faint(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", stage.name, record.seconds,
                                readableSize(record.output_bytes), stage.subject)));
}

std::optional<Failure> startReadyStages(Plan& plan, std::vector<size_t>& stage_of_child,
                                        ChildProcesses& children, const CookOptions& options)
{
    for (size_t i = 0; i < plan.size() && children.running() < options.jobs; ++i)
    {
        Stage& stage = plan[i];
        const auto isDone = [&](size_t before) { return plan[before].state == Stage::State::done; };
        if (stage.state != Stage::State::waiting ||
            !std::all_of(stage.after.begin(), stage.after.end(), isDone))
            continue;
        if (options.verbosity == Verbosity::all)
            print(faint(joined(stage.command)));
        const Result<size_t> child = children.start(stage.command);
        if (!child.ok())
            return failureOf(child.error(), stage.source);
        stage.state = Stage::State::running;
        stage_of_child.push_back(i);
    }
    return std::nullopt;
}

/// Run the stages, up to `jobs` at once, in the order of the plan; the first that fails ends the cook.
std::optional<Failure> runPlan(Plan& plan, ChildProcesses& children, const CookOptions& options,
                               CookOutcome& outcome)
{
    std::vector<StageRecord> records(plan.size());
    std::vector<size_t> stage_of_child;
    for (size_t done = 0; done < plan.size(); ++done)
    {
        if (auto failure = startReadyStages(plan, stage_of_child, children, options))
            return failure;
        const std::optional<ChildEnd> end = children.wait();
        if (!end)
            return Failure{kInterrupted, "interrupted", options.sources.size()};

        const size_t index = stage_of_child[end->id];
        Stage& stage = plan[index];
        const std::vector<std::string> lines = linesOf(inUsersWords(end->messages, plan));
        passOn(lines, options.verbosity);
        if (auto failure = failureOf(stage, *end, lines))
            return failure;
        stage.state = Stage::State::done;
        records[index] = {stage.name,       stage.source,        end->seconds,
                          end->cpu_seconds, end->peak_rss_bytes, sizeOf(stage.output)};
        printStage(options, stage, records[index]);
    }
    outcome.stages = std::move(records);
    return std::nullopt;
}

// ---- before and after

Status checkOutput(const CookOptions& options)
{
    std::error_code error;
    if (std::filesystem::is_directory(options.output, error))
        return Error{Issue::cannot_write, options.output, "", "is a folder"};
    for (const std::string& source : options.sources)
        if (std::filesystem::equivalent(source, options.output, error))
            return Error{Issue::usage, options.output, "", "the output would overwrite a source"};
    HEARTH_ASSIGN_OR_RETURN(const std::vector<LodFile> lods, parseLodFiles(options.lods));
    if (!lods.empty() && options.sources.size() > 1)
        return Error{Issue::usage, "--lod", "",
                     "needs a cook of one source: which of several it is for is not said"};
    for (const LodFile& lod : lods)
        if (std::filesystem::equivalent(lod.path, options.output, error))
            return Error{Issue::usage, options.output, "", "the output would overwrite a level of detail"};
    return success();
}

std::string textOf(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// META of the pack at `path`, for the report.
std::string metaOf(const std::string& path)
{
    const auto reader = formats::ContainerReader::open(path, formats::Check::structure);
    if (!reader.ok())
        return "";
    const auto meta = reader->read(formats::kChunkMeta);
    if (!meta.ok())
        return "";
    return {reinterpret_cast<const char*>(meta->bytes().data()), meta->bytes().size()};
}

Status writeReport(const CookOptions& options, const CookOutcome& outcome)
{
    const std::string meta = outcome.exit_code == 0 ? metaOf(options.output) : "";
    HEARTH_ASSIGN_OR_RETURN(WholeFile file, WholeFile::create(options.report_file));
    file.write(reportJson(options, outcome, meta));
    return file.finish();
}

/// Cook into private folders and move the pack into place; the folders go when this returns.
std::optional<Failure> cookInPrivate(const CookOptions& options, CookOutcome& outcome)
{
    // first, so that it goes last: signals wait until the folders are gone
    ChildProcesses children;
    const auto fail = [&](const Error& error) { return failureOf(error, options.sources.size()); };
    if (const Status status = checkOutput(options); !status.ok())
        return fail(status.error());

    // the pack is written beside its place, where a rename can put it; the parts go where the user keeps such things
    const Result<PrivateFolder> beside = PrivateFolder::create(folderOf(options.output), options.output);
    if (!beside.ok())
        return fail(beside.error());
    const Result<PrivateFolder> parts = PrivateFolder::create(temporaryOr(beside->path()), options.output);
    if (!parts.ok())
        return fail(parts.error());

    Plan plan;
    const std::string programs = programFolder();
    const std::string packed = beside->path() + "/pack.hearth";
    std::vector<size_t> inputs;
    for (size_t i = 0; i < options.sources.size(); ++i)
        for (const size_t part : addSource(plan, programs, parts->path(), i, options))
            inputs.push_back(part);
    addLink(plan, programs, parts->path(), packed, inputs, options);
    if (auto failure = runPlan(plan, children, options, outcome))
        return failure;

    if (!options.report_file.empty())
        for (size_t i = 0; i < options.sources.size(); ++i)
            outcome.cluster_statistics.push_back(textOf(statisticsFile(parts->path(), i)));
    if (!options.report_file.empty() && options.bricks)
        outcome.brick_statistics = textOf(brickStatisticsFile(parts->path()));
    outcome.output_bytes = sizeOf(packed);
    if (::rename(packed.c_str(), options.output.c_str()) != 0)
        return fail(
            {Issue::cannot_write, options.output, "", std::string("cannot write: ") + std::strerror(errno)});
    return std::nullopt;
}

} // namespace

int cook(const CookOptions& options)
{
    const auto start = std::chrono::steady_clock::now();
    CookOutcome outcome;
    if (const std::optional<Failure> failure = cookInPrivate(options, outcome))
    {
        outcome.exit_code = failure->exit_code;
        outcome.error = failure->error;
        outcome.failed_source = failure->source;
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (outcome.exit_code == 0 && options.verbosity != Verbosity::quiet)
        print(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", "cooked", outcome.seconds,
                          readableSize(outcome.output_bytes), options.output));

    if (!options.report_file.empty() && outcome.exit_code != kInterrupted)
        if (const Status status = writeReport(options, outcome); !status.ok())
        {
            print(formatMessage(status.error()));
            return outcome.exit_code != 0 ? outcome.exit_code : exitCode(status.error());
        }
    return outcome.exit_code;
}

} // namespace hearth::command
