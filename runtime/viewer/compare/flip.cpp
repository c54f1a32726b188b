// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/compare/flip.h"

#include "formats/base/double3.h"

#include <algorithm>
#include <cmath>

namespace hearth::viewer
{

namespace
{

constexpr double kPi = 3.14159265358979323846;

Double3 operator*(Double3 a, Double3 b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

Double3& operator+=(Double3& a, Double3 b)
{
    return a = a + b;
}

Double3 abs(Double3 a)
{
    return {std::abs(a.x), std::abs(a.y), std::abs(a.z)};
}

/// Image of three channels, or of one in x only; reads beyond the border are clamped to it.
struct Field
{
    long width, height;
    std::vector<Double3> values;

    const Double3& clamped(long x, long y) const
    {
        return values[static_cast<size_t>(std::clamp(y, 0L, height - 1) * width +
                                          std::clamp(x, 0L, width - 1))];
    }

    template <typename Function>
    Field mapped(const Function& function) const
    {
        Field result{width, height, {}};
        result.values.reserve(values.size());
        for (const Double3& value : values)
            result.values.push_back(function(value));
        return result;
    }
};

// ---- colour spaces, paper section 4.1; linear RGB is Rec.709, its white is the reference white

Double3 xyzFromRgb(Double3 c)
{
    return {dot(c, {0.4124564, 0.3575761, 0.1804375}), dot(c, {0.2126729, 0.7151522, 0.0721750}),
            dot(c, {0.0193339, 0.1191920, 0.9503041})};
}

Double3 rgbFromXyz(Double3 c)
{
    return {dot(c, {3.2404542, -1.5371385, -0.4985314}), dot(c, {-0.9692660, 1.8760108, 0.0415560}),
            dot(c, {0.0556434, -0.2040259, 1.0572252})};
}

Double3 whiteXyz()
{
    return xyzFromRgb({1, 1, 1});
}

Double3 relativeToWhite(Double3 xyz)
{
    const Double3 white = whiteXyz();
    return {xyz.x / white.x, xyz.y / white.y, xyz.z / white.z};
}

/// Convert to linearised L*a*b*: luminance, red-green, blue-yellow.
Double3 opponentFromRgb(Double3 rgb)
{
    const Double3 r = relativeToWhite(xyzFromRgb(rgb));
    return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
}

Double3 rgbFromOpponent(Double3 c)
{
    const double y = (c.x + 16) / 116;
    return rgbFromXyz(Double3{y + c.y / 500, y, y - c.z / 200} * whiteXyz());
}

double labCurve(double t)
{
    constexpr double kDelta = 6.0 / 29;
    return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3 * kDelta * kDelta) + 4.0 / 29;
}

/// Convert to L*a*b* with less chroma in the dark (Hunt effect).
Double3 huntLabFromRgb(Double3 rgb)
{
    const Double3 r = relativeToWhite(xyzFromRgb(rgb));
    const double lightness = 116 * labCurve(r.y) - 16;
    return {lightness, 0.01 * lightness * 500 * (labCurve(r.x) - labCurve(r.y)),
            0.01 * lightness * 200 * (labCurve(r.y) - labCurve(r.z))};
}

double hyAb(Double3 a, Double3 b)
{
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// ---- colour difference, paper sections 4.1 and 4.2

/// Contrast sensitivity of each channel: sums of up to two Gaussians in the distance in degrees.
struct ContrastSensitivity
{
    double a1, b1, a2, b2;

    double at(double distance2) const
    {
        return a1 * std::sqrt(kPi / b1) * std::exp(-kPi * kPi * distance2 / b1) +
               a2 * std::sqrt(kPi / b2) * std::exp(-kPi * kPi * distance2 / b2);
    }
};

constexpr ContrastSensitivity kLuminance{1, 0.0047, 0, 1e-5};
constexpr ContrastSensitivity kRedGreen{1, 0.0053, 0, 1e-5};
constexpr ContrastSensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};

/// Blur away the detail that the eye cannot resolve at this distance.
Field filterByContrastSensitivity(const Field& opponent, double pixels_per_degree)
{
    const auto radius =
        static_cast<long>(std::ceil(3 * std::sqrt(kBlueYellow.b1 / (2 * kPi * kPi)) * pixels_per_degree));
    const long side = 2 * radius + 1;
    std::vector<Double3> kernel;
    Double3 sum;
    for (long y = -radius; y <= radius; ++y)
        for (long x = -radius; x <= radius; ++x)
        {
            const double distance2 =
                static_cast<double>(x * x + y * y) / (pixels_per_degree * pixels_per_degree);
            kernel.push_back({kLuminance.at(distance2), kRedGreen.at(distance2), kBlueYellow.at(distance2)});
            sum += kernel.back();
        }
    Field blurred{opponent.width, opponent.height, {}};
    for (long y = 0; y < opponent.height; ++y)
        for (long x = 0; x < opponent.width; ++x)
        {
            Double3 value;
            for (long ky = 0; ky < side; ++ky)
                for (long kx = 0; kx < side; ++kx)
                    value += kernel[static_cast<size_t>(ky * side + kx)] *
                             opponent.clamped(x + kx - radius, y + ky - radius);
            blurred.values.push_back({value.x / sum.x, value.y / sum.y, value.z / sum.z});
        }
    return blurred;
}

Double3 clampedToUnit(Double3 c)
{
    return {std::clamp(c.x, 0.0, 1.0), std::clamp(c.y, 0.0, 1.0), std::clamp(c.z, 0.0, 1.0)};
}

constexpr double kColorExponent = 0.7;

/// Largest possible difference, between pure green and pure blue, with the exponent of the measure.
double largestColorDifference()
{
    return std::pow(hyAb(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColorExponent);
}

/// Remap to 0..1: the lower 40 % of the range fill 95 % of the scale.
double remapColorDifference(double difference, double largest)
{
    constexpr double kKneeIn = 0.4, kKneeOut = 0.95;
    const double knee = kKneeIn * largest;
    if (difference < knee)
        return difference * kKneeOut / knee;
    return kKneeOut + (difference - knee) / (largest - knee) * (1 - kKneeOut);
}

// ---- feature difference, paper section 4.3

/// First or second derivative of a Gaussian along x; positive weights sum to 1, negative ones to -1.
struct DerivativeKernel
{
    long radius;
    std::vector<double> weights;

    DerivativeKernel(double pixels_per_degree, bool second)
    {
        constexpr double kFeatureWidthDegrees = 0.082;
        const double sigma = 0.5 * kFeatureWidthDegrees * pixels_per_degree;
        radius = static_cast<long>(std::ceil(3 * sigma));
        double positive = 0, negative = 0;
        for (long y = -radius; y <= radius; ++y)
            for (long x = -radius; x <= radius; ++x)
            {
                const auto dx = static_cast<double>(x), dy = static_cast<double>(y);
                const double gaussian = std::exp(-(dx * dx + dy * dy) / (2 * sigma * sigma));
                const double weight = (second ? dx * dx / (sigma * sigma) - 1 : -dx) * gaussian;
                weights.push_back(weight);
                (weight > 0 ? positive : negative) += std::abs(weight);
            }
        for (double& weight : weights)
            weight /= weight > 0 ? positive : negative;
    }

    /// Length of the derivative in x and y at a pixel of channel x.
    double convolve(const Field& field, long x, long y) const
    {
        double along_x = 0, along_y = 0;
        size_t i = 0;
        for (long ky = -radius; ky <= radius; ++ky)
            for (long kx = -radius; kx <= radius; ++kx, ++i)
            {
                along_x += weights[i] * field.clamped(x + kx, y + ky).x;
                along_y += weights[i] * field.clamped(x + ky, y + kx).x;
            }
        return std::hypot(along_x, along_y);
    }
};

/// Strength of edges (x) and points (y) at each pixel.
Field detectFeatures(const Field& opponent, double pixels_per_degree)
{
    const Field luminance = opponent.mapped([](Double3 c) { return Double3{(c.x + 16) / 116, 0, 0}; });
    const DerivativeKernel edge(pixels_per_degree, false), point(pixels_per_degree, true);
    Field features{opponent.width, opponent.height, {}};
    for (long y = 0; y < opponent.height; ++y)
        for (long x = 0; x < opponent.width; ++x)
            features.values.push_back({edge.convolve(luminance, x, y), point.convolve(luminance, x, y), 0});
    return features;
}

Field toOpponentSpace(const Image& image)
{
    Field field{static_cast<long>(image.width), static_cast<long>(image.height), {}};
    for (size_t i = 0; i < image.rgb.size(); i += 3)
    {
        const auto linear = [&](size_t channel) { return linearFromSrgb(image.rgb[i + channel] / 255.0); };
        field.values.push_back(opponentFromRgb({linear(0), linear(1), linear(2)}));
    }
    return field;
}

/// Precomputed fields of one image.
struct ImageFields
{
    Field lab;
    Field features;

    ImageFields(const Image& image, double pixels_per_degree)
    {
        const Field opponent = toOpponentSpace(image);
        lab = filterByContrastSensitivity(opponent, pixels_per_degree)
                  .mapped([](Double3 c) { return huntLabFromRgb(clampedToUnit(rgbFromOpponent(c))); });
        features = detectFeatures(opponent, pixels_per_degree);
    }
};

} // namespace

double FlipMap::mean() const
{
    double sum = 0;
    for (const float value : error)
        sum += double{value};
    return sum / static_cast<double>(error.size());
}

FlipMap flip(const Image& reference, const Image& test, double pixels_per_degree)
{
    HEARTH_ASSERT(reference.width == test.width && reference.height == test.height && !reference.rgb.empty());
    const ImageFields a(reference, pixels_per_degree), b(test, pixels_per_degree);
    const double largest = largestColorDifference();
    FlipMap map{reference.width, reference.height, {}};
    map.error.reserve(a.lab.values.size());
    for (size_t i = 0; i < a.lab.values.size(); ++i)
    {
        const double color =
            remapColorDifference(std::pow(hyAb(a.lab.values[i], b.lab.values[i]), kColorExponent), largest);
        const Double3 edges = abs(a.features.values[i] - b.features.values[i]);
        const double feature = std::sqrt(std::max(edges.x, edges.y) / std::sqrt(2.0));
        map.error.push_back(static_cast<float>(std::pow(color, 1 - std::min(feature, 1.0))));
    }
    return map;
}

Image makeFlipImage(const FlipMap& map)
{
    Image image(map.width, map.height);
    for (size_t i = 0; i < map.error.size(); ++i)
    {
        const double e = double{map.error[i]};
        const double rgb[3] = {
            std::min(1.0, 1.7 * e), std::clamp(1.6 * e - 0.5, 0.0, 1.0),
            std::clamp(e < 0.5 ? 1.1 * e : 0.55 - 1.6 * (e - 0.5) + 3.2 * std::max(0.0, e - 0.7), 0.0, 1.0)};
        for (size_t channel = 0; channel < 3; ++channel)
            image.rgb[i * 3 + channel] = static_cast<uint8_t>(rgb[channel] * 255 + 0.5);
    }
    return image;
}

} // namespace hearth::viewer
