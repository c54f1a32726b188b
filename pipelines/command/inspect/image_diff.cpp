// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/image_diff.h"

#include "cook/tools/child_processes.h"
#include "formats/base/regular_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/graph/cooker_outcome.h"

namespace hearth::command
{

namespace
{

constexpr int kInterrupted = 130;

struct Program
{
    std::string name;    ///< "render"
    std::string subject; ///< file that its errors name
    std::vector<std::string> arguments;
};

ImageDiff failed(const graph::Failure& failure)
{
    return {failure.exit_code, failure.error, ""};
}

/// Run programs side by side. The first that fails ends the others.
ImageDiff runPrograms(const std::vector<Program>& programs)
{
    tools::ChildProcesses children;
    for (const Program& program : programs)
    {
        std::vector<std::string> command{tools::programFolder() + "/hearth-" + program.name};
        command.insert(command.end(), program.arguments.begin(), program.arguments.end());
        if (const Result<size_t> child = children.start(command); !child.ok())
            return failed(graph::makeFailure(child.error(), 0));
    }
    while (children.running() > 0)
    {
        const std::optional<tools::ChildOutcome> end = children.wait();
        if (!end)
            return {kInterrupted, "interrupted", ""};
        graph::Action action;
        action.cooker = programs[end->id].name;
        action.subject = programs[end->id].subject;
        if (const auto failure = graph::makeFailure(action, *end, graph::splitLines(end->messages)))
            return failed(*failure);
    }
    return {};
}

} // namespace

ImageDiff diffImages(const std::string& pack_a, const std::string& pack_b, const ImageDiffOptions& options)
{
    const Result<TempDirectory> folder =
        TempDirectory::create(temporaryFolderOr(parentFolder(options.output)), options.output);
    if (!folder.ok())
        return failed(graph::makeFailure(folder.error(), 0));
    const std::string image_a = folder->path() + "/a.png";
    const std::string image_b = folder->path() + "/b.png";
    const std::string figures = folder->path() + "/figures.json";
    const auto render = [&](const std::string& pack, const std::string& image)
    {
        Program program{"render", pack, {pack, "-o", image}};
        program.arguments.insert(program.arguments.end(), options.view.begin(), options.view.end());
        return program;
    };
    ImageDiff drawn = runPrograms({render(pack_a, image_a), render(pack_b, image_b)});
    if (drawn.exit_code != 0)
        return drawn;
    ImageDiff compared =
        runPrograms({{"compare",
                      options.output,
                      {image_a, "--with", image_b, "-o", options.output, "--stats", figures}}});
    if (const Result<std::string> text = readFile(figures); compared.exit_code == 0 && text.ok())
        compared.figures = *text;
    return compared;
}

} // namespace hearth::command
