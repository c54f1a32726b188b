// hearth-samples: writes small glTF sources made by code alone.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/program.h"
#include "sample_assets/glb_writer.h"
#include "sample_assets/samples.h"

#include <CLI/CLI.hpp>

#include <cstdio>

namespace
{

int fail(const hearth::Error& error)
{
    std::fprintf(stderr, "%s\n", hearth::formatMessage(error).c_str());
    return hearth::exitCode(error);
}

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
    CLI::App app("Writes a sample scene as GLB. The same options give the same bytes.\n"
                 "Example: hearth-samples rock --triangles 2000000 -o rock.glb");
    std::string kind, output;
    hearth::samples::SampleOptions options;
    bool list = false;
    app.add_option("KIND", kind, "which sample; see --list");
    app.add_option("-o,--output", output, "file to write");
    app.add_option("--triangles", options.triangles, "about how many triangles the main mesh shall have")
        ->check(CLI::Range(uint64_t{12}, uint64_t{1} << 26));
    app.add_option("--texture-size", options.texture_size, "texels along a side of the main textures")
        ->check(CLI::Range(1u, 8192u));
    app.add_flag("--list", list, "list the kinds of sample");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit(error) == 0 ? 0 : 2;
    }
    if (list)
        return listKinds();
    if (kind.empty() || output.empty())
        return fail({hearth::Issue::usage, "", "", "name a KIND and an output file (-o)"});
    const hearth::Status written = writeSample(kind, options, output);
    return written.ok() ? 0 : fail(written.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-samples", [&] { return program(argc, argv); });
}
