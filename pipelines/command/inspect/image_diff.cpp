// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/image_diff.h"

#include "formats/base/regular_file.h"
#include "formats/base/temp_directory.h"
#include "pipelines/command/shell/run_programs.h"

namespace hearth::command
{

namespace
{

ImageDiff failed(const graph::Failure& failure)
{
    return {failure.exit_code, failure.error, ""};
}

/// Run programs side by side. returns  the failure of the first that fails
ImageDiff runAll(const std::vector<Program>& programs)
{
    const std::optional<graph::Failure> failure = runPrograms(programs);
    return failure ? failed(*failure) : ImageDiff{};
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
    ImageDiff drawn = runAll({render(pack_a, image_a), render(pack_b, image_b)});
    if (drawn.exit_code != 0)
        return drawn;
    ImageDiff compared = runAll({{"compare",
                                  options.output,
                                  {image_a, "--with", image_b, "-o", options.output, "--stats", figures}}});
    if (const Result<std::string> text = readFile(figures); compared.exit_code == 0 && text.ok())
        compared.figures = *text;
    return compared;
}

} // namespace hearth::command
