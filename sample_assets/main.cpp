// hearth-samples: writes small glTF sources made by code alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "formats/base/program.h"
#include "sample_assets/samples.h"
#include "sample_assets/shapes/glb_writer.h"

#include <cstdio>

namespace
{

int listKinds()
{
    for (const hearth::samples::SampleKind& kind : hearth::samples::sampleKinds())
        std::printf("%-10.*s %.*s\n", static_cast<int>(kind.name.size()), kind.name.data(),
                    static_cast<int>(kind.summary.size()), kind.summary.data());
    return 0;
}

hearth::Status writeSample(const std::string& kind, const hearth::samples::SampleOptions& options,
                           const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const hearth::samples::Document document,
                            hearth::samples::generateSample(kind, options));
    return hearth::samples::writeFile(path, hearth::samples::encodeGlb(document));
}

int program(int argc, char** argv)
{
    hearth::cli::CommandLine app("Writes a sample scene as GLB. The same options give the same bytes.\n"
                                 "Example: hearth-samples rock --triangles 2000000 -o rock.glb");
    std::string kind, output;
    hearth::samples::SampleOptions options;
    bool list = false;
    app.addOption("KIND", kind, "which sample; see --list");
    app.addOption("-o,--output", output, "file to write");
    app.addOption("--triangles", options.triangles, "about how many triangles the main mesh shall have")
        .range(uint64_t{12}, uint64_t{1} << 26);
    app.addOption("--texture-size", options.texture_size, "texels along a side of the main textures")
        .range(1u, 8192u);
    app.addFlag("--list", list, "list the kinds of sample");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    if (list)
        return listKinds();
    if (kind.empty() || output.empty())
        return hearth::reportFailure({hearth::Issue::usage, "", "", "name a KIND and an output file (-o)"});
    const hearth::Status written = writeSample(kind, options, output);
    return written.ok() ? 0 : hearth::reportFailure(written.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-samples", [&] { return program(argc, argv); });
}
