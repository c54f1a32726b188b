// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <cmath>

namespace hearth::test
{

const std::vector<MalformedPack>& malformedProxies()
{
    static const std::vector<MalformedPack> list = {
        {"proxyOfNoMesh", Issue::meaning_reference, "proxy 1", [](PackModel& p) { p.proxies[1].mesh = 99; }},
        {"proxyOrder", Issue::meaning_order, "proxy 1",
         [](PackModel& p) { std::swap(p.proxies[0].mesh, p.proxies[1].mesh); }},
        {"proxyOrigin", Issue::meaning_value, "proxy 0", [](PackModel& p) { p.proxies[0].origin = 3; }},
        {"proxyHalfClosed", Issue::meaning_value, "proxy 0",
         [](PackModel& p) { p.proxies[0].is_closed = 2; }},
        {"proxyNegativeDistance", Issue::meaning_value, "proxy 0",
         [](PackModel& p) { p.proxies[0].distance = -1; }},
        {"proxyDistanceIsNoNumber", Issue::meaning_value, "proxy 1",
         [](PackModel& p) { p.proxies[1].mesh_distance = NAN; }},
        {"proxyReserved", Issue::meaning_padding, "proxy 0",
         [](PackModel& p) { p.proxies[0].reserved[2] = 1; }},
        {"proxyWithoutTriangles", Issue::meaning_range, "proxy 1",
         [](PackModel& p)
         {
             p.proxies[1].indices.count = 0;
             p.proxy_indices.resize(12);
         }},
        {"proxyHalfTriangle", Issue::meaning_range, "proxy 1",
         [](PackModel& p)
         {
             p.proxies[1].indices.count = 2;
             p.proxy_indices.pop_back();
         }},
        {"proxyPositionNotFinite", Issue::meaning_value, "proxy 0",
         [](PackModel& p) { p.proxy_positions[1].y = INFINITY; }},
        {"proxyIndexBeyondPositions", Issue::meaning_reference, "proxy 1",
         [](PackModel& p) { p.proxy_indices[13] = 3; }},
        {"proxyPositionsBeyondTable", Issue::meaning_range, "proxy 1",
         [](PackModel& p) { p.proxy_positions.pop_back(); }},
        {"proxyPositionsOfNone", Issue::meaning_range, "proxy position 7",
         [](PackModel& p) { p.proxy_positions.push_back({}); }},
        {"proxyPositionsOverlap", Issue::meaning_order, "proxy 1",
         [](PackModel& p) { p.proxies[1].positions.first = 3; }},
        {"proxySectionsOverlap", Issue::meaning_range, "proxy 0",
         [](PackModel& p) { p.proxy_sections[1].triangles.first = 0; }},
        {"proxySectionsEndEarly", Issue::meaning_range, "proxy 0",
         [](PackModel& p) { p.proxy_sections[1].triangles.count = 2; }},
        {"proxySectionBeyondTriangles", Issue::meaning_range, "proxy 0",
         [](PackModel& p) { p.proxy_sections[1].triangles.count = 0xFFFFFFFF; }},
        {"proxyEmptySection", Issue::meaning_range, "proxy 0",
         [](PackModel& p) { p.proxy_sections[0].triangles.count = 0; }},
        {"proxySectionConvex", Issue::meaning_value, "proxy 0",
         [](PackModel& p) { p.proxy_sections[0].is_convex = 2; }},
        {"proxySectionOfNoMaterial", Issue::meaning_reference, "proxy 0",
         [](PackModel& p) { p.proxy_sections[0].material = 99; }},
        {"proxyBindingToNoTriangle", Issue::meaning_reference, "proxy 0",
         [](PackModel& p) { p.proxy_bindings[0].triangle = 4; }},
        {"proxyBindingWeights", Issue::meaning_value, "proxy 0",
         [](PackModel& p) { p.proxy_bindings[0].weights[0] = 32768; }},
        {"proxyBindingDistance", Issue::meaning_value, "proxy 0",
         [](PackModel& p) { p.proxy_bindings[0].distance = INFINITY; }},
        {"proxyBindingMissing", Issue::meaning_range, "proxy 0",
         [](PackModel& p)
         {
             p.proxy_bindings.pop_back();
             --p.proxies[0].bindings.count;
             --p.proxies[1].bindings.first;
         }},
    };
    return list;
}

} // namespace hearth::test
