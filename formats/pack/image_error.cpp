// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/image_error.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace hearth::formats
{

namespace
{

bool misses(double error, double target)
{
    return target != 0 && error > target;
}

} // namespace

std::string_view imageRoleName(uint32_t role)
{
    constexpr std::string_view kNames[] = {"none", "color", "cutout", "emissive", "data", "normal", "light"};
    return role < std::size(kNames) ? kNames[role] : "unknown";
}

std::string_view imageErrorUnit(ImageRole role)
{
    return role == ImageRole::normal ? "degrees" : role == ImageRole::light ? "stops" : "psnr_db";
}

double convertImageError(ImageRole role, double error)
{
    if (role == ImageRole::normal)
        return error * 180 / std::numbers::pi;
    return role == ImageRole::light ? error : -20 * std::log10(error);
}

double restoreImageError(ImageRole role, double converted)
{
    if (role == ImageRole::normal)
        return converted * std::numbers::pi / 180;
    return role == ImageRole::light ? converted : std::pow(10.0, -converted / 20);
}

std::string imageErrorText(ImageRole role, double error)
{
    if (error == 0)
        return "exact";
    const double converted = convertImageError(role, error);
    char text[64];
    if (role == ImageRole::normal)
        std::snprintf(text, sizeof(text), "%.2f degrees", converted);
    else if (role == ImageRole::light)
        std::snprintf(text, sizeof(text), "%.3f stops", converted);
    else
        std::snprintf(text, sizeof(text), "%.1f dB", converted);
    return text;
}

std::string imageErrorText(ImageRole role, double error, double target)
{
    const std::string text = imageErrorText(role, error);
    if (target == 0)
        return text;
    std::string bound = imageErrorText(role, target);
    if (error != 0) // which has the unit
        bound.resize(bound.find(' '));
    return text + " (target " + bound + (misses(error, target) ? ", missed)" : ")");
}

bool holdsTargets(const ImageRecord& image)
{
    return !misses(double{image.error}, double{image.target}) &&
           !misses(double{image.error_smooth}, double{image.target_smooth});
}

} // namespace hearth::formats
