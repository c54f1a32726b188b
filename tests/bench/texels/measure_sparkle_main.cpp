// hearth_measure_sparkle: draws bumpy floors at a distance, with mips whose roughness was raised and without,
// and compares the energy of the sun's reflection with that of the bumps themselves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/command_line/command_line.h"
#include "cook/tools/child_processes.h"
#include "formats/base/half.h"
#include "formats/base/program.h"
#include "pipelines/import/images/decode.h"
#include "runtime/viewer/camera_path.h"
#include "sample_assets/shapes/glb_writer.h"
#include "tests/bench/aims.h"
#include "tests/bench/texels/bumpy_floor.h"
#include "tests/picture/programs.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace
{

using namespace hearth;

constexpr uint32_t kWidth = 320;
constexpr uint32_t kHeight = 180;
constexpr uint32_t kPointsPerSide = 16;

const std::vector<std::string> kPhones{};
const std::vector<std::string> kUnchanged{"--set", "textures.specular_aa=false"};

std::string findProgram(const char* name)
{
    return tools::programFolder() + "/" + name;
}

/// Return the mean of the green channel of a picture of half floats.
Result<double> averageGreen(const std::string& path)
{
    const std::string bytes = picture::readBytes(path);
    HEARTH_ASSIGN_OR_RETURN(const import::DecodedImage image,
                            import::decodeImage(std::as_bytes(std::span(bytes)), path, {}));
    if (!image.isFloat() || image.texelBytes() != 8)
        return Error{Issue::image_unsupported, path, "", "not of half floats"};
    double sum = 0;
    for (size_t i = 0; i < size_t{image.width} * image.height; ++i)
    {
        uint16_t half = 0;
        std::memcpy(&half, &image.texels[i * 8 + 2], sizeof(half));
        sum += double{floatFromHalf(half)};
    }
    return sum / image.width / image.height;
}

/// Cook and draw a floor, and return the mean radiance of the picture.
Result<double> drawFloor(const std::string& work, const bench::BumpyFloor& floor,
                         const std::vector<std::string>& options)
{
    const std::string source = work + "/floor.glb", pack = work + "/floor.hearth",
                      image = work + "/floor.exr";
    HEARTH_TRY(samples::writeFile(source, samples::encodeGlb(bench::makeBumpyFloor(floor))));
    std::vector<std::string> command{findProgram("hearth"), "cook",         "-q",  source,     "-o", pack,
                                     "--no-cache",          "--visibility", "off", "--bricks", "off"};
    command.insert(command.end(), options.begin(), options.end());
    HEARTH_TRY(picture::runProgram(command));
    HEARTH_TRY(picture::runProgram({findProgram("hearth-render"), pack, "-o", image, "--size",
                                    fmt::format("{}x{}", kWidth, kHeight), "--samples", "4", "--shadows",
                                    "off", "--camera", viewer::formatCamera(bench::floorCamera(floor))}));
    return averageGreen(image);
}

/// Return the energy of the drawn reflection of the sun, over that of the supersampled bumps, less 1.
Result<double> measureFloor(const std::string& work, bench::BumpyFloor floor,
                            const std::vector<std::string>& options)
{
    const double wanted = bench::reflectedSun(floor, kWidth, kHeight, kPointsPerSide);
    HEARTH_ASSIGN_OR_RETURN(const double bright, drawFloor(work, floor, options));
    floor.sun *= 0.5f; // the difference is the sun's alone, without the sky's reflection
    HEARTH_ASSIGN_OR_RETURN(const double dim, drawFloor(work, floor, options));
    return 2 * (bright - dim) / wanted - 1;
}

/// returns  exit code: 1 if an aim is missed
Result<int> measure(const std::string& work)
{
    std::filesystem::create_directories(work);
    bench::Judgement judgement("sparkle");
    HEARTH_ASSIGN_OR_RETURN(const double flat, measureFloor(work, {.slope = 0}, kPhones));
    fmt::print("Energy of the sun's reflection on floors at a distance, beside {} points a pixel of mip 0\n"
               "flat floor {:+.1f} %\n\n{:>9} {:>6} {:>10} {:>12} {:>16}\n",
               kPointsPerSide * kPointsPerSide, 100 * flat, "elevation", "slope", "roughness", "phones",
               "no specular_aa");
    judgement.record("energy lost or gained, flat", std::abs(flat));
    for (const float elevation : {20.0f, 45.0f})
        for (const auto& [slope, roughness] : {std::pair(0.1f, 0.2f), std::pair(0.25f, 0.4f)})
        {
            const bench::BumpyFloor floor{.slope = slope, .roughness = roughness, .elevation_deg = elevation};
            HEARTH_ASSIGN_OR_RETURN(const double phones, measureFloor(work, floor, kPhones));
            HEARTH_ASSIGN_OR_RETURN(const double unchanged, measureFloor(work, floor, kUnchanged));
            fmt::print("{:>9} {:>6} {:>10} {:>+10.1f} % {:>+14.1f} %\n", elevation, slope, roughness,
                       100 * phones, 100 * unchanged);
            std::fflush(stdout);
            judgement.record("energy lost or gained, bumpy", std::abs(phones));
        }
    return judgement.finish();
}

int run(int argc, char** argv)
{
    cli::CommandLine app("Measures the energy of reflections on bumpy floors at a distance.");
    std::string work = "build/bench/sparkle";
    app.addOption("--work", work, "folder of all files that are made");
    if (const std::optional<int> exit_code = app.parse(argc, argv))
        return *exit_code;
    const Result<int> measured = measure(work);
    return measured.ok() ? *measured : reportFailure(measured.error());
}

} // namespace

int main(int argc, char** argv)
{
    return hearth::runProgram("hearth_measure_sparkle", [&] { return run(argc, argv); });
}
