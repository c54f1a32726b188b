// Compares methods for the specular occlusion of a cone, each against the exact value.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/specular/configurations.h"

#include <string>
#include <vector>

namespace hearth::specular
{

/// Errors over random configurations.
struct ErrorFigures
{
    std::string name;
    double rms = 0;
    double bias = 0; ///< mean of value - exact
    double p95 = 0;  ///< 95th percentile of the magnitude
    double largest = 0;
};

struct Comparison
{
    TableSettings settings;
    size_t configuration_count = 0;
    std::vector<ErrorFigures> methods;        ///< methods, against the exact value of the five numbers
    std::vector<ErrorFigures> astc;           ///< nodes as read from ASTC textures, against the table
    std::vector<ErrorFigures> interpolations; ///< unrounded tables, against the interpolated function
    /// Table's nodes against a quadrature of four times as many points along each axis.
    double quadrature_rms = 0;
    double quadrature_largest = 0;
};

/// Compare all methods. Deterministic; takes seconds for a thousand configurations.
Comparison compare(const TableSettings& settings, size_t configuration_count, uint64_t seed);

/// Format for people.
std::string comparisonText(const Comparison& comparison);

/// Format as JSON, schema "hearth.specular/1".
std::string comparisonJson(const Comparison& comparison, double cook_seconds);

} // namespace hearth::specular
