// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/scene/daylight.h"

#include "formats/gpu_shared/shading.h"
#include "formats/gpu_shared/sky.h"
#include "formats/scene/scene_lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace hearth::shared
{

namespace
{

constexpr double kPi = std::numbers::pi;
constexpr double kGroundReflectance = 0.2;

using Color = std::array<double, 3>; ///< linear sRGB

double radians(double degrees)
{
    return degrees * kPi / 180;
}

Float3 toFloat3(const Color& color)
{
    return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
}

/// Return the linear sRGB colour of a luminance and a chromaticity.
Color fromChromaticity(double luminance, double x, double y)
{
    const double X = luminance * x / y;
    const double Z = luminance * (1 - x - y) / y;
    const Color color = {3.2406 * X - 1.5372 * luminance - 0.4986 * Z,
                         -0.9689 * X + 1.8758 * luminance + 0.0415 * Z,
                         0.0557 * X - 0.2040 * luminance + 1.0570 * Z};
    return {std::max(color[0], 0.0), std::max(color[1], 0.0), std::max(color[2], 0.0)};
}

// ---- sun

/// Return the length of the sun's way through air, 1 from the zenith.
/// source  Kasten's formula, as Preetham, appendix 1 has it
double airMass(double zenith_angle)
{
    return 1 / (std::cos(zenith_angle) + 0.15 * std::pow(93.885 - zenith_angle * 180 / kPi, -1.253));
}

/// Return the illuminance of a surface that faces the sun, in lux. Each primary stands for one wavelength.
Color sunIlluminance(double zenith_angle, double turbidity)
{
    constexpr double kOutside = 128'000;            // lux at the top of the atmosphere
    constexpr Color kWhite = {1.117, 0.974, 0.916}; // 5778 K, luminance 1
    constexpr Color kMicrometres = {0.612, 0.549, 0.465};
    constexpr Color kOzone = {0.120, 0.085, 0.0075}; // absorption in 1/cm
    constexpr double kOzoneCentimetres = 0.35;
    constexpr double kAerosolExponent = 1.3; // by the size of the particles
    const double aerosol = 0.04608 * turbidity - 0.04586;
    const double mass = airMass(zenith_angle);
    Color result;
    for (size_t i = 0; i < 3; ++i)
    {
        const double depth = 0.008735 * std::pow(kMicrometres[i], -4.08) +
                             aerosol * std::pow(kMicrometres[i], -kAerosolExponent) +
                             kOzone[i] * kOzoneCentimetres;
        result[i] = kOutside * kWhite[i] * std::exp(-depth * mass);
    }
    return result;
}

// ---- sky

/// Perez' distribution of luminance or of a chromaticity over the sky.
struct Perez
{
    double a, b, c, d, e;

    double operator()(double cos_zenith, double sun_angle) const
    {
        const double cos_sun = std::cos(sun_angle);
        // near the horizon the formula divides by nearly nothing
        return (1 + a * std::exp(b / std::max(cos_zenith, 0.01))) *
               (1 + c * std::exp(d * sun_angle) + e * cos_sun * cos_sun);
    }
};

/// Return a chromaticity at the zenith: cubic in the angle of the sun, quadratic in turbidity.
double zenithChromaticity(const double (&rows)[3][4], double sun, double turbidity)
{
    double sum = 0, power = turbidity * turbidity;
    for (const auto& row : rows)
    {
        sum += power * (((row[0] * sun + row[1]) * sun + row[2]) * sun + row[3]);
        power /= turbidity;
    }
    return sum;
}

/// Radiance of a clear sky in cd/m2.
class ClearSky
{
public:
    ClearSky(double sun_zenith_angle, double turbidity)
        : sun_(sun_zenith_angle),
          luminance_{0.1787 * turbidity - 1.4630, -0.3554 * turbidity + 0.4275, -0.0227 * turbidity + 5.3251,
                     0.1206 * turbidity - 2.5771, -0.0670 * turbidity + 0.3703},
          x_{-0.0193 * turbidity - 0.2592, -0.0665 * turbidity + 0.0008, -0.0004 * turbidity + 0.2125,
             -0.0641 * turbidity - 0.8989, -0.0033 * turbidity + 0.0452},
          y_{-0.0167 * turbidity - 0.2608, -0.0950 * turbidity + 0.0092, -0.0079 * turbidity + 0.2102,
             -0.0441 * turbidity - 1.6537, -0.0109 * turbidity + 0.0529}
    {
        constexpr double kX[3][4] = {{0.00166, -0.00375, 0.00209, 0},
                                     {-0.02903, 0.06377, -0.03202, 0.00394},
                                     {0.11693, -0.21196, 0.06052, 0.25886}};
        constexpr double kY[3][4] = {{0.00275, -0.00610, 0.00317, 0},
                                     {-0.04214, 0.08970, -0.04153, 0.00516},
                                     {0.15346, -0.26756, 0.06670, 0.26688}};
        const double chi = (4.0 / 9 - turbidity / 120) * (kPi - 2 * sun_);
        const double luminance =
            1000 * ((4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192);
        luminance_scale_ = luminance / luminance_(1, sun_);
        x_scale_ = zenithChromaticity(kX, sun_, turbidity) / x_(1, sun_);
        y_scale_ = zenithChromaticity(kY, sun_, turbidity) / y_(1, sun_);
    }

    /// azimuth  from the sun's
    Color radiance(double cos_zenith, double azimuth) const
    {
        const double sin_zenith = std::sqrt(std::max(0.0, 1 - cos_zenith * cos_zenith));
        const double cos_angle =
            std::cos(sun_) * cos_zenith + std::sin(sun_) * sin_zenith * std::cos(azimuth);
        const double angle = std::acos(std::clamp(cos_angle, -1.0, 1.0));
        return fromChromaticity(luminance_scale_ * luminance_(cos_zenith, angle),
                                x_scale_ * x_(cos_zenith, angle), y_scale_ * y_(cos_zenith, angle));
    }

private:
    double sun_;
    Perez luminance_, x_, y_;
    double luminance_scale_, x_scale_, y_scale_;
};

constexpr size_t kSkyHeights = 64;

/// Mean radiance of each height, the middles of equal steps from 0 to 1.
std::array<Color, kSkyHeights> meanRadiances(const ClearSky& sky)
{
    constexpr size_t kAzimuths = 32;
    std::array<Color, kSkyHeights> means{};
    for (size_t i = 0; i < kSkyHeights; ++i)
        for (size_t j = 0; j < kAzimuths; ++j)
        {
            const double height = (static_cast<double>(i) + 0.5) / kSkyHeights;
            const Color color = sky.radiance(height, kPi * (static_cast<double>(j) + 0.5) / kAzimuths);
            for (size_t c = 0; c < 3; ++c)
                means[i][c] += color[c] / kAzimuths;
        }
    return means;
}

/// Colours of the gradient, in cd/m2.
struct Gradient
{
    Color zenith, horizon;
};

/// Return the gradient of least squares above the horizon, scaled to the irradiance of the means.
Gradient fitGradient(const std::array<Color, kSkyHeights>& means, const Color& ground)
{
    Gradient result;
    for (size_t c = 0; c < 3; ++c)
    {
        double hh = 0, hz = 0, zz = 0, h = 0, z = 0;        // normal equations
        double of_means = 0, of_horizon = 0, of_zenith = 0; // irradiance, but for a common factor
        for (size_t i = 0; i < kSkyHeights; ++i)
        {
            const double height = (static_cast<double>(i) + 0.5) / kSkyHeights;
            const double above = skyAbove(static_cast<float>(height));
            const double high = skyHigh(static_cast<float>(height));
            const double horizon = above * (1 - high), zenith = above * high;
            const double rest = means[i][c] - ground[c] * (1 - above);
            hh += horizon * horizon;
            hz += horizon * zenith;
            zz += zenith * zenith;
            h += horizon * rest;
            z += zenith * rest;
            of_means += height * rest;
            of_horizon += height * horizon;
            of_zenith += height * zenith;
        }
        const double determinant = hh * zz - hz * hz;
        const double fitted_horizon = std::max(0.0, (h * zz - z * hz) / determinant);
        const double fitted_zenith = std::max(0.0, (z * hh - h * hz) / determinant);
        const double irradiance = fitted_horizon * of_horizon + fitted_zenith * of_zenith;
        const double scale = irradiance > 0 ? std::max(0.0, of_means / irradiance) : 0;
        result.horizon[c] = scale * fitted_horizon;
        result.zenith[c] = scale * fitted_zenith;
    }
    return result;
}

Color scaled(const Color& color, double factor)
{
    return {color[0] * factor, color[1] * factor, color[2] * factor};
}

} // namespace

Status checkDaylight(const Daylight& daylight)
{
    const auto fail = [](const std::string& detail) { return Error{Issue::usage, "", "daylight", detail}; };
    if (!(daylight.elevation_deg >= 0 && daylight.elevation_deg <= 90))
        return fail("the sun's elevation is not 0 to 90 degrees");
    if (!std::isfinite(daylight.azimuth_deg))
        return fail("the sun's azimuth is not finite");
    if (!(daylight.turbidity >= 2.5f && daylight.turbidity <= 8))
        return fail("the turbidity is not 2.5 to 8");
    return success();
}

DaylightColors makeDaylight(const Daylight& daylight)
{
    const double elevation = radians(double{daylight.elevation_deg});
    const double azimuth = radians(double{daylight.azimuth_deg});
    const double sun_zenith_angle = kPi / 2 - elevation;
    const Color sun = sunIlluminance(sun_zenith_angle, double{daylight.turbidity});
    const std::array<Color, kSkyHeights> means =
        meanRadiances(ClearSky(sun_zenith_angle, double{daylight.turbidity}));

    Color ground;
    for (size_t c = 0; c < 3; ++c)
    {
        double irradiance = sun[c] * std::sin(elevation);
        for (size_t i = 0; i < kSkyHeights; ++i)
            irradiance +=
                2 * kPi * means[i][c] * (static_cast<double>(i) + 0.5) / (double{kSkyHeights} * kSkyHeights);
        ground[c] = kGroundReflectance / kPi * irradiance;
    }
    const Gradient gradient = fitGradient(means, ground);

    const double of_default = double{luminance(kSunIlluminance)};
    const double exposure = of_default / double{luminance(toFloat3(sunIlluminance(kPi / 4, 3)))};
    const double level = std::cos(elevation);
    return {.sun_direction =
                toFloat3({-std::sin(azimuth) * level, -std::sin(elevation), std::cos(azimuth) * level}),
            .sun_illuminance = toFloat3(scaled(sun, exposure)),
            .zenith = toFloat3(scaled(gradient.zenith, exposure)),
            .horizon = toFloat3(scaled(gradient.horizon, exposure)),
            .ground = toFloat3(scaled(ground, exposure))};
}

} // namespace hearth::shared
