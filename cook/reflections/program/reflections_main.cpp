// hearth-reflections: cooks light probes within the scene of one or more sources.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/scene_light.h"
#include "cook/bricks/voxels/scene_sky.h"
#include "cook/bricks/voxels/source_parts.h"
#include "cook/command_line/command_line.h"
#include "cook/command_line/thread_limit.h"
#include "cook/probes/probe.h"
#include "cook/reflections/capture/capture.h"
#include "cook/reflections/place/probe_place.h"
#include "formats/base/program.h"
#include "formats/container/container_writer.h"
#include "formats/scene/sky_image.h"
#include "formats/texels/shared_exponent.h"

#include <cstdio>

namespace
{

using namespace hearth;
using namespace hearth::reflections;

/// Share of a probe's directions that may meet backs of surfaces: a probe that stands in a piece of
/// furniture sees the room through its missing backs, one in a wall sees backs all around.
constexpr double kMaxBlackShare = 0.5;

// The weight of a probe is 1 in its box, and fades outside of it: walls are on the box, and those of
// the next room are behind them by more than this.
constexpr float kFade = 0.2f;
constexpr float kFadeShare = 0.1f; ///< of the box's shortest edge, for small scenes

struct Arguments
{
    std::vector<std::string> inputs;
    std::vector<std::string> places;
    std::string output;
    std::string probe; ///< part with the probe of the sky, or empty
    uint32_t face_size = formats::kMaxLocalProbeSide;
    size_t jobs = 0;
};

/// Scene that probes are captured in.
struct Stage
{
    Surfaces surfaces;
    shared::SceneLighting lighting;
    std::optional<environment::Environment> sky;
};

/// Return the mip of roughness 0 of the sky's probe, as radiance.
environment::Environment decodeSky(const formats::ProbeRecord& probe, std::span<const uint32_t> texels)
{
    const uint32_t side = probe.face_size;
    environment::Environment sky{environment::Layout::cube, side, side, {}};
    const auto first =
        static_cast<size_t>(formats::cubeTexelCount(formats::finestProbeSide(probe), probe.sharp_mips));
    for (const uint32_t word : texels.subspan(first, size_t{6} * side * side))
    {
        const std::array<float, 3> color = formats::decodeSharedExponent(word);
        sky.texels.push_back(Float3{color[0], color[1], color[2]} * probe.irradiance_luminance);
    }
    return sky;
}

Result<Stage> readStage(const bricks::StaticScene& scene, const std::string& probe)
{
    HEARTH_ASSIGN_OR_RETURN(Surfaces surfaces, Surfaces::read(scene));
    HEARTH_ASSIGN_OR_RETURN(const bricks::SceneSky sky, bricks::SceneSky::open(scene, probe));
    const shared::SceneProbes probes = sky.probes();
    Stage stage{std::move(surfaces), bricks::makeSceneLighting(scene, probes), {}};
    if (const std::optional<size_t> i = shared::findSkyProbe(probes.records))
    {
        const formats::ProbeRecord& record = probes.records[*i];
        stage.sky = decodeSky(record, probes.texels.subspan(record.texels.first, record.texels.count));
    }
    return stage;
}

/// Set the fields of a local probe.
void setPlace(const ProbePlace& place, const Box3& box, const Capture& capture, formats::ProbeRecord& record)
{
    const Float3 size = box.max - box.min;
    const float fade = place.fade.value_or(std::min(kFade, kFadeShare * std::min({size.x, size.y, size.z})));
    const Float3 margin{fade, fade, fade};
    record.flags = formats::kProbeIsLocal;
    record.position = place.position;
    record.box_min = box.min;
    record.box_max = box.max;
    record.influence_min = box.min - margin;
    record.influence_max = box.max + margin;
    record.fade = fade;
    const Float4 share = capture.sky_share;
    const float values[] = {share.x, share.y, share.z, share.w};
    std::ranges::copy(values, record.sky_share);
    std::ranges::transform(capture.lamp_harmonics, record.lamp_harmonics,
                           [&](float value) { return value / record.irradiance_luminance; });
}

/// Cook a probe, and name it in messages by its number and its text.
Result<probes::Probe> cookPlace(const Stage& stage, const ProbePlace& place, const std::string& name,
                                uint32_t side)
{
    const Capture capture = captureRadiance(stage.surfaces, stage.lighting, stage.sky, place.position, side);
    if (capture.black_share > kMaxBlackShare)
        return Error{Issue::probe_enclosed, name, "",
                     std::to_string(static_cast<int>(100 * capture.black_share)) +
                         " % of its rays meet backs of surfaces"};
    HEARTH_ASSIGN_OR_RETURN(probes::Probe probe, probes::cookProbe(capture.radiance, name, side));
    setPlace(place, place.box ? *place.box : findBox(stage.surfaces, place.position), capture, probe.record);
    return probe;
}

Status writePart(const std::string& path, std::span<const probes::Probe> probes)
{
    std::vector<formats::ProbeRecord> records;
    std::vector<uint32_t> texels;
    for (const probes::Probe& probe : probes)
    {
        records.push_back(probe.record);
        records.back().texels.first = static_cast<uint32_t>(texels.size());
        texels.insert(texels.end(), probe.texels.begin(), probe.texels.end());
    }
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerWriter writer,
                            formats::ContainerWriter::create(path, formats::ContainerKind::part));
    HEARTH_TRY(writer.addRecords<formats::ProbeRecord>(formats::kChunkProbes, records));
    HEARTH_TRY(writer.addRecords<uint32_t>(formats::kChunkProbeTexels, texels));
    return writer.finish();
}

Status run(const Arguments& arguments)
{
    const cli::ThreadLimit limit(arguments.jobs);
    std::vector<ProbePlace> places;
    for (const std::string& text : arguments.places)
    {
        HEARTH_ASSIGN_OR_RETURN(const ProbePlace place, parseProbePlace(text));
        places.push_back(place);
    }
    HEARTH_ASSIGN_OR_RETURN(const std::vector<bricks::SourceParts> sources,
                            bricks::openSources(arguments.inputs));
    HEARTH_ASSIGN_OR_RETURN(const bricks::StaticScene scene, bricks::collectStaticScene(sources));
    HEARTH_ASSIGN_OR_RETURN(const Stage stage, readStage(scene, arguments.probe));
    std::vector<probes::Probe> probes;
    for (size_t i = 0; i < places.size(); ++i)
    {
        const std::string name = "probe " + std::to_string(i) + " at " + arguments.places[i];
        HEARTH_ASSIGN_OR_RETURN(probes::Probe probe, cookPlace(stage, places[i], name, arguments.face_size));
        probes.push_back(std::move(probe));
    }
    HEARTH_TRY(stage.surfaces.status());
    if (places.size() > shared::kMaxLocalProbes)
        std::fprintf(stderr, "%s\n",
                     formatMessage({Issue::dropped, arguments.output, "",
                                    "the runtime draws the first " + std::to_string(shared::kMaxLocalProbes) +
                                        " of " + std::to_string(places.size()) + " probes"})
                         .c_str());
    return writePart(arguments.output, probes);
}

int program(int argc, char** argv)
{
    constexpr std::array kFaceSizes{32u, 64u};
    cli::CommandLine app("Cooks light probes within a scene: what surfaces around a point reflect.",
                         "hearth-reflections");
    Arguments arguments;
    app.addOption("PARTS", arguments.inputs, "import, clusters and textures part of each source").required();
    app.addOption("-o,--output", arguments.output, "probe part to write").required();
    app.addOption(
           "--at", arguments.places,
           "a probe: X,Y,Z in metres; with :MIN:MAX, two corners of the box that it lights, found by rays "
           "along the axes if they are not given; with :FADE, the metres over which it fades around the "
           "box; may be given again")
        .oneValueEach()
        .required();
    app.addOption("--probe", arguments.probe,
                  "probe part of the sky that lights the scene; default: the default sky");
    app.addOption("--face-size", arguments.face_size, "texels along an edge of the cube")
        .choices(kFaceSizes, "N")
        .showDefault();
    app.addOption("-j,--jobs", arguments.jobs, "threads to use; the result does not depend on it");
    app.setFooter(
        "Example: hearth-reflections room.import.part room.clusters.part room.textures.part --at 2,1.5,2 -o "
        "room.probes.part\n"
        "Exit codes: 0 done, 2 usage, 65 malformed input, 66 input missing, 70 internal, 73 cannot write, "
        "74 I/O");
    app.setCheck(
        [&arguments]
        {
            return arguments.inputs.size() % 3 == 0 ? std::string()
                                                    : "PARTS: three parts are needed for each source";
        });
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Status status = run(arguments);
    return status.ok() ? 0 : reportFailure(status.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth-reflections", [&] { return program(argc, argv); });
}
