// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <tbb/parallel_for.h>

namespace hearth::specular
{

using namespace formats;

namespace
{

constexpr uint32_t kNodes = shared::kSpecularNodes;
constexpr double kQuarterTurn = std::numbers::pi / 2;

} // namespace

AssumedLobe assumeLobe(double roughness, double beta, const TableSettings& settings)
{
    const double theta_o =
        (1 - settings.normal_lambda) * beta / 2 + settings.normal_lambda * std::min(beta, kQuarterTurn);
    const double tilt = theta_o - beta;
    return {{roughness, theta_o, settings.masking}, {std::sin(tilt), 0, std::cos(tilt)}};
}

TableValues cookTable(const TableSettings& settings)
{
    TableValues values{};
    std::array<double, kNodes> half_angles{};
    for (uint32_t i = 0; i < kNodes; ++i)
        half_angles[i] = kQuarterTurn * specularNodeAperture(i);
    tbb::parallel_for(uint32_t{0}, kNodes * kNodes,
                      [&](uint32_t row)
                      {
                          const double beta = std::acos(specularNodeCosBeta(row / kNodes, settings.spacing));
                          const AssumedLobe place =
                              assumeLobe(specularNodeRoughness(row % kNodes), beta, settings);
                          std::array<double, kNodes> shares{};
                          computeOcclusions(place.lobe, place.axis, half_angles, shares);
                          // a wider cone holds no less: a decrease is an error of the quadrature
                          double least = 0;
                          for (uint32_t i = 0; i < kNodes; ++i)
                          {
                              least = std::max(least, shares[i]);
                              values[row * kNodes + i] = static_cast<float>(least);
                          }
                      });
    return values;
}

SpecularTableRecord packTable(const TableValues& values, const TableSettings& settings)
{
    SpecularTableRecord record{};
    record.aperture_nodes = record.roughness_nodes = record.beta_nodes = kNodes;
    record.spacing = static_cast<uint32_t>(settings.spacing);
    record.masking = static_cast<uint32_t>(settings.masking);
    record.normal_lambda = static_cast<float>(settings.normal_lambda);
    record.min_roughness = shared::kMinSpecularRoughness;
    std::transform(values.begin(), values.end(), std::begin(record.values),
                   [](float value) { return static_cast<uint8_t>(value * 255.0f + 0.5f); });
    return record;
}

TableValues unpackTable(const SpecularTableRecord& record)
{
    TableValues values{};
    std::transform(std::begin(record.values), std::end(record.values), values.begin(),
                   [](uint8_t value) { return static_cast<float>(value) / 255.0f; });
    return values;
}

float lookUp(const TableValues& values, SpecularSpacing spacing, float cos_aperture, float roughness,
             float cos_beta)
{
    const Float3 place = shared::specularTableCoordinates(cos_aperture, roughness, cos_beta,
                                                          static_cast<shared::uint>(spacing));
    constexpr float kLast = float{kNodes - 1};
    std::array<uint32_t, 3> first{};
    std::array<float, 3> part{};
    for (int axis = 0; axis < 3; ++axis)
    {
        const float at = place[axis] * kLast;
        const auto i = static_cast<size_t>(axis);
        first[i] = std::min(static_cast<uint32_t>(at), kNodes - 2);
        part[i] = at - static_cast<float>(first[i]);
    }
    float sum = 0;
    for (uint32_t corner = 0; corner < 8; ++corner)
    {
        uint32_t node = 0;
        float weight = 1;
        for (uint32_t axis = 3; axis-- > 0;)
        {
            const uint32_t step = corner >> axis & 1;
            node = node * kNodes + first[axis] + step;
            weight *= step == 1 ? part[axis] : 1 - part[axis];
        }
        sum += weight * values[node];
    }
    return sum;
}

} // namespace hearth::specular
