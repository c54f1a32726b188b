// hearth-probe: cooks the light probe of an environment.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/probes/probe.h"
#include "formats/base/program.h"
#include "formats/container/container_writer.h"
#include "pipelines/environments/read_environment.h"

namespace
{

using namespace hearth;

struct Arguments
{
    std::string environment;
    std::string output;
    uint32_t face_size = probes::kProbeSide;
    uint32_t max_sky_size = probes::kMaxSkySide;
    size_t jobs = 0;
};

Status writePart(const std::string& path, const probes::Probe& probe)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerWriter writer,
                            formats::ContainerWriter::create(path, formats::ContainerKind::part));
    HEARTH_TRY(writer.addRecords<formats::ProbeRecord>(formats::kChunkProbes, {&probe.record, 1}));
    HEARTH_TRY(writer.addRecords<uint32_t>(formats::kChunkProbeTexels, probe.texels));
    return writer.finish();
}

Status run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    HEARTH_ASSIGN_OR_RETURN(const environment::Environment environment,
                            environments::readEnvironment(arguments.environment));
    HEARTH_ASSIGN_OR_RETURN(
        probes::Probe probe,
        probes::cookProbe(environment, arguments.environment, arguments.face_size, arguments.max_sky_size));
    probe.record.flags = formats::kProbeIsSky;
    return writePart(arguments.output, probe);
}

int program(int argc, char** argv)
{
    constexpr std::array kFaceSizes{32u, 64u, 128u, 256u, 512u};
    cli::CommandLine app(
        "Cooks a light probe: what surfaces of each roughness reflect of an environment, and its "
        "harmonics.");
    Arguments arguments;
    app.addOption("ENVIRONMENT", arguments.environment,
                  "HDR, EXR or KTX2 image: lat-long, twice as wide as high, or a KTX2 cube")
        .required();
    app.addOption("-o,--output", arguments.output, "probe part to write").required();
    app.addOption("--face-size", arguments.face_size, "texels along an edge of the cube")
        .choices(kFaceSizes, "N")
        .showDefault();
    app.addOption("--sky-size", arguments.max_sky_size,
                  "largest edge of the sky that the camera sees, which is no finer than the image")
        .range(1u, 4096u, "N")
        .showDefault();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.setFooter(
        "Example: hearth-probe sky.hdr -o sky.probe.part\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status status = run(arguments);
    return status.ok() ? 0 : reportFailure(status.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-probe", [&] { return program(argc, argv); });
}
