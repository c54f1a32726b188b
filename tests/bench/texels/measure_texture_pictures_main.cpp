// hearth_measure_texture_pictures: draws scenes with textures for phones and with plain ones, and compares
// the pictures. Mips, levels of detail, and light are the same, so that the coding of texels alone differs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/child_processes.h"
#include "formats/base/atomic_file.h"
#include "formats/base/program.h"
#include "runtime/viewer/camera_fit.h"
#include "runtime/viewer/camera_path.h"
#include "tests/bench/aims.h"
#include "tests/picture/programs.h"
#include "tests/reference/flip.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace
{

using namespace hearth;
namespace fs = std::filesystem;

constexpr uint32_t kWidth = 640;
constexpr uint32_t kHeight = 360;
constexpr float kCloseUp = 2; ///< ratio of the angles of the two views

struct Arguments
{
    std::string work = "build/bench/texture-pictures";
    std::vector<std::string> sources;
};

/// Two pictures that differ in their textures.
struct PictureError
{
    double mean = 0;          ///< FLIP over all pixels
    double percentile_99 = 0; ///< FLIP that a pixel of a hundred exceeds
};

struct SourceErrors
{
    PictureError whole, close;
};

std::string findProgram(const char* name)
{
    return tools::programFolder() + "/" + name;
}

Status cook(const Arguments& arguments, const std::string& source, const std::string& pack, bool plain)
{
    std::vector<std::string> command{findProgram("hearth"),
                                     "cook",
                                     "-q",
                                     source,
                                     "-o",
                                     pack,
                                     "--cache",
                                     "dir:" + arguments.work + "/cache",
                                     "--visibility",
                                     "off",
                                     "--bricks",
                                     "off"};
    if (plain)
        command.insert(command.end(), {"--set", "textures.families=[]"});
    return picture::runProgram(command);
}

/// Draw the views of a path into STEM-0000.png, ...
Status draw(const std::string& pack, const std::string& path, const std::string& stem)
{
    return picture::runProgram({findProgram("hearth-render"), pack, "-o", stem + ".png", "--size",
                                fmt::format("{}x{}", kWidth, kHeight), "--samples", "4", "--camera-path",
                                path});
}

Result<PictureError> compareView(const std::string& stem, size_t view)
{
    HEARTH_ASSIGN_OR_RETURN(const reference::Image plain,
                            reference::readPng(viewer::numberedFile(stem + "-plain.png", view)));
    HEARTH_ASSIGN_OR_RETURN(const reference::Image phone,
                            reference::readPng(viewer::numberedFile(stem + "-phone.png", view)));
    reference::FlipMap map = reference::flip(plain, phone);
    HEARTH_TRY(
        reference::writePng(viewer::numberedFile(stem + "-heat.png", view), reference::makeFlipImage(map)));
    PictureError error{.mean = map.mean()};
    const auto rank = static_cast<std::ptrdiff_t>(map.error.size() * 99 / 100);
    std::nth_element(map.error.begin(), map.error.begin() + rank, map.error.end());
    error.percentile_99 = double{map.error[static_cast<size_t>(rank)]};
    return error;
}

/// Return the first camera that the artist placed, else one that shows the whole scene.
Result<shared::Camera> placeCamera(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(formats::ContainerReader reader, formats::ContainerReader::open(path));
    HEARTH_ASSIGN_OR_RETURN(const formats::PackView pack, formats::PackView::read(std::move(reader)));
    const bool has_camera =
        !pack.cameras().empty() &&
        static_cast<formats::CameraType>(pack.cameras()[0].type) == formats::CameraType::perspective;
    return has_camera ? viewer::sceneCamera(pack, 0)
                      : viewer::fitCamera(pack, float{kWidth} / float{kHeight});
}

Result<SourceErrors> measureSource(const Arguments& arguments, const std::string& source)
{
    const std::string stem = arguments.work + "/" + fs::path(source).stem().string();
    HEARTH_TRY(cook(arguments, source, stem + "-plain.hearth", true));
    HEARTH_TRY(cook(arguments, source, stem + "-phone.hearth", false));
    HEARTH_ASSIGN_OR_RETURN(shared::Camera camera, placeCamera(stem + "-plain.hearth"));
    std::string path = viewer::formatCamera(camera) + "\n";
    camera.y_fov_rad /= kCloseUp;
    path += viewer::formatCamera(camera) + "\n";
    HEARTH_TRY(writeText(stem + "-views.txt", path));
    for (const char* cook : {"-plain", "-phone"})
        HEARTH_TRY(draw(stem + cook + ".hearth", stem + "-views.txt", stem + cook));
    SourceErrors errors;
    HEARTH_ASSIGN_OR_RETURN(errors.whole, compareView(stem, 0));
    HEARTH_ASSIGN_OR_RETURN(errors.close, compareView(stem, 1));
    return errors;
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const Arguments& arguments)
{
    fs::create_directories(arguments.work);
    bench::Judgement judgement("texture-pictures");
    fmt::print("FLIP of phone textures beside plain ones, {} x {} pixels\n{:28} {:>13} {:>8} {:>13} {:>8}\n",
               kWidth, kHeight, "", "whole, mean", "99 %", "close, mean", "99 %");
    for (const std::string& source : arguments.sources)
    {
        HEARTH_ASSIGN_OR_RETURN(const SourceErrors errors, measureSource(arguments, source));
        const auto& [whole, close] = errors;
        fmt::print("{:28.28} {:>13.4f} {:>8.3f} {:>13.4f} {:>8.3f}\n", fs::path(source).stem().string(),
                   whole.mean, whole.percentile_99, close.mean, close.percentile_99);
        std::fflush(stdout);
        judgement.record("mean FLIP beside plain textures, whole", whole.mean);
        judgement.record("mean FLIP beside plain textures, close", close.mean);
    }
    fmt::print("pictures and heat maps: {}\n", arguments.work);
    return judgement.finish();
}

int run(int argc, char** argv)
{
    cli::CommandLine app("Compares pictures of phone textures with those of plain ones.");
    Arguments arguments;
    app.addOption("source", arguments.sources, "scenes to cook; of different file names").required();
    app.addOption("--work", arguments.work, "folder of all files that are made");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(arguments);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_texture_pictures", [&] { return run(argc, argv); });
}
