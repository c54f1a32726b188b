// Registry of the limits that benches hold, and the judgement of what they measured: a bench whose figure
// misses its aim, or was not measured, ends with exit code 1 and names it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace hearth::bench
{

enum class Bound
{
    at_most,
    at_least,
};

struct Aim
{
    std::string_view bench;  ///< argument of `./dev bench`, or name of a Google benchmark
    std::string_view figure; ///< with its unit
    Bound bound;
    double limit;
};

/// All limits that any bench holds. `./dev bench cook` and `./dev bench runtime`'s opening print figures
/// without one.
inline constexpr std::array kAims = {
    Aim{"runtime", "clusters drawn / seen", Bound::at_most, 1.6},
    Aim{"runtime", "triangles a covered pixel", Bound::at_most, 1.35},
    Aim{"runtime", "frame of convergence from a cold start", Bound::at_most, 40},
    Aim{"runtime", "mean FLIP within the budget", Bound::at_most, 0.01},
    Aim{"many-lights", "evaluated / reaching, 192 lights", Bound::at_most, 1.3},
    Aim{"many-lights", "evaluated / reaching, 1024 lights", Bound::at_most, 1.45},
    Aim{"many-lights", "evaluated / reaching, 4096 lights", Bound::at_most, 1.65},
    Aim{"many-lights", "evaluated / reaching as drawn, 192 lights", Bound::at_most, 1.3},
    Aim{"many-lights", "evaluated / reaching as drawn, 1024 lights", Bound::at_most, 1.45},
    Aim{"many-lights", "CPU assignment of 192 lights, ms", Bound::at_most, 0.35},
    Aim{"many-lights", "CPU assignment of 1024 lights, ms", Bound::at_most, 1},
    Aim{"many-lights", "CPU assignment of 4096 lights, ms", Bound::at_most, 2},
    Aim{"many-lights", "spot cells / real ones", Bound::at_most, 1.08},
    Aim{"clusters", "cuts beyond their stored error", Bound::at_most, 0},
    Aim{"clusters", "triangles / clod's for equal rms", Bound::at_most, 1},
    Aim{"clusters", "triangles / clod's for equal normals", Bound::at_most, 1},
    Aim{"error", "cuts beyond their stored error", Bound::at_most, 0},
    Aim{"error", "cuts whose distance is not CGAL's", Bound::at_most, 0},
    Aim{"error", "box left, part of its diagonal", Bound::at_most, 0.1},
    Aim{"error", "median stored error / distance, generated", Bound::at_most, 1.6},
    Aim{"cuts", "triangles a pixel for a mean FLIP of 0.1", Bound::at_most, 4.6},
    Aim{"bricks", "seconds for voxels of 1 m", Bound::at_most, 10},
    Aim{"bricks", "finest voxels within 28 MiB, m", Bound::at_most, 1},
    Aim{"light", "rms error at voxels of 0.1 m: room", Bound::at_most, 0.15},
    Aim{"light", "rms error at voxels of 0.1 m: attic", Bound::at_most, 0.3},
    Aim{"light", "rms error at voxels of 0.1 m: cornell", Bound::at_most, 0.3},
    Aim{"light", "rms error at voxels of 0.1 m: terrain", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: spheres", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: spheres", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: spheres", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: shoe", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: shoe", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: shoe", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: barrel", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: barrel", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: barrel", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: emissive", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: emissive", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: emissive", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: fox", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: fox", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: fox", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: foliage", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: foliage", Bound::at_most, 0.06},
    Aim{"picture", "FLIP, default above all on: foliage", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: outdoor", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: outdoor", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: outdoor", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: terrain", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: terrain", Bound::at_most, 0.035},
    Aim{"picture", "FLIP, default above all on: terrain", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: cornell", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: cornell", Bound::at_most, 0.095},
    Aim{"picture", "FLIP, default above all on: cornell", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: room", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: room", Bound::at_most, 0.1},
    Aim{"picture", "FLIP, default above all on: room", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, nothing occludes: demo", Bound::at_most, 0.03},
    Aim{"picture", "FLIP, all on: demo", Bound::at_most, 0.1},
    Aim{"picture", "FLIP, default above all on: demo", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, lights without shadows: night", Bound::at_most, 0.02},
    Aim{"picture", "FLIP, lights with shadows: night", Bound::at_most, 0.02},
    Aim{"picture", "error of light on sky-lit walls: outdoor", Bound::at_most, 0.03},
    Aim{"picture", "rms of ambient occlusion: demo", Bound::at_most, 0.02},
    Aim{"textures", "bytes / those of 6x6, colours and data", Bound::at_most, 0.65},
    Aim{"textures", "bytes / those of one footprint that holds the targets, colours and data", Bound::at_most,
        0.65},
    Aim{"textures", "worst error / that of 6x6, colours and data", Bound::at_most, 1},
    Aim{"textures", "bytes / those of 4x4, normals", Bound::at_most, 1},
    Aim{"textures", "worst error / that of 4x4, normals", Bound::at_most, 1},
    Aim{"textures", "search / one encoding, 1024", Bound::at_most, 0.35},
    Aim{"textures", "search / one encoding, 2048", Bound::at_most, 0.1},
    Aim{"textures", "draft of the demo, s of processor", Bound::at_most, 5},
    Aim{"mip-filters", "mean FLIP / that of a Kaiser filter", Bound::at_most, 1},
    Aim{"texture-pictures", "mean FLIP beside plain textures, whole", Bound::at_most, 0.01},
    Aim{"texture-pictures", "mean FLIP beside plain textures, close", Bound::at_most, 0.01},
    Aim{"texture-errors", "stored error off its recount", Bound::at_most, 1e-6},
    Aim{"texture-errors", "stored error off its recount, cut-outs", Bound::at_most, 1e-6},
    Aim{"texture-errors", "error_p999 below its recount, of the range", Bound::at_most, 1 / 65535.},
    Aim{"texture-errors", "error_p999 above its recount, of the range", Bound::at_most, 1e-3},
    Aim{"texture-errors", "stored coverage off its recount", Bound::at_most, 1e-6},
    Aim{"texture-errors", "targets other than documented", Bound::at_most, 0},
    Aim{"texture-errors", "targets missed without a warning", Bound::at_most, 0},
    Aim{"texture-errors", "warnings of targets that are held", Bound::at_most, 0},
    Aim{"texture-streaming", "GiB of texels", Bound::at_least, 2},
    Aim{"texture-streaming", "frames beyond the budget", Bound::at_most, 0},
    Aim{"texture-streaming", "pixels no blurrier than wanted, all views, %", Bound::at_least, 99},
    Aim{"texture-streaming", "pixels no blurrier than wanted, worst view, %", Bound::at_least, 97},
    Aim{"texture-streaming", "frames until a view has settled", Bound::at_most, 300},
    Aim{"sparkle", "energy lost or gained, flat", Bound::at_most, 0.02},
    Aim{"sparkle", "energy lost or gained, bumpy", Bound::at_most, 0.1},
    Aim{"visibility", "any hit, share of the fastest bare loop", Bound::at_least, 0.8},
    Aim{"visibility", "nearest hit, share of the fastest bare loop", Bound::at_least, 0.8},
    Aim{"occlusion", "rms difference of ambient occlusion", Bound::at_most, 0.006},
    Aim{"bc", "BC1, dB less than exhaustive", Bound::at_most, 0.1},
    Aim{"bc", "BC1, Mtexel/s", Bound::at_least, 0.5},
    Aim{"bc", "BC7, dB less than exhaustive", Bound::at_most, 0.5},
    Aim{"bc", "BC7, Mtexel/s", Bound::at_least, 0.5},
    Aim{"etc2", "dB below exhaustive search: RGB8", Bound::at_most, 0.2},
    Aim{"etc2", "dB below exhaustive search: RG11", Bound::at_most, 0.2},
    Aim{"etc2", "dB below exhaustive search: alpha", Bound::at_most, 0.2},
    Aim{"etc2", "Mtexel/s of a core, normal: RGB8", Bound::at_least, 0.5},
    Aim{"etc2", "Mtexel/s of a core, normal: RG11", Bound::at_least, 0.5},
    Aim{"etc2", "Mtexel/s of a core, normal: alpha", Bound::at_least, 1},
    Aim{"etc2", "Mtexel/s of a core, draft: RGB8", Bound::at_least, 1.5},
    Aim{"probe", "s of processor", Bound::at_most, 3},
    Aim{"probe", "error of a mip, rms", Bound::at_most, 0.005},
    Aim{"probe", "mean of a mip off the environment's", Bound::at_most, 0.003},
    Aim{"probe", "error of storing, rms", Bound::at_most, 0.002},
    Aim{"receivers", "rms of all on", Bound::at_most, 0.015},
    Aim{"receivers", "rms of random weights", Bound::at_most, 0.015},
    Aim{"receivers", "jump between neighbouring texels", Bound::at_most, 0.01},
    Aim{"receivers", "records of 16 bytes a texel", Bound::at_most, 2.2},
    Aim{"receiver-scene", "rms of all on", Bound::at_most, 0.015},
    Aim{"receiver-scene", "rms of random weights", Bound::at_most, 0.015},
    Aim{"receiver-scene", "jump between neighbouring texels", Bound::at_most, 0.01},
    Aim{"receiver-scene", "records of 16 bytes a texel", Bound::at_most, 2.2},
    Aim{"receiver-scene", "specks of all lamps", Bound::at_most, 50},
    Aim{"receiver-scene", "rms error of all lamps beside paths", Bound::at_most, 0.08},
    Aim{"receiver-bake", "s of processor for a million texels, 8 lights, one bounce", Bound::at_most, 120},
    Aim{"receiver-bake", "s of processor for a million texels, 8 lights, all bounces", Bound::at_most, 120},
    Aim{"wrap", "s of processor for 200,000 triangles", Bound::at_most, 10},
    Aim{"proxies", "proxies that are no manifold, or not closed as stored", Bound::at_most, 0},
    Aim{"proxies", "distances beyond their stored bound", Bound::at_most, 0},
    Aim{"proxies", "proxies with a vertex that is not bound", Bound::at_most, 0},
    Aim{"proxies", "largest stored bound / certified distance", Bound::at_most, 1.15},
    Aim{"kills", "packs, caches or folders that a kill broke", Bound::at_most, 0},
    Aim{"kills", "kills that caught a cook at work", Bound::at_least, 50},
    Aim{"marchLanesFromFaces", "items_per_second", Bound::at_least, 5e6},
    Aim{"solution/real_time", "seconds", Bound::at_most, 0.5},
};

/// Return the aim of a bench's figure, which must be among `aims`.
const Aim& findAim(std::string_view bench, std::string_view figure, std::span<const Aim> aims = kAims);

/// Collects the figures of one bench and compares them with its aims.
class Judgement
{
public:
    /// aims  the registry, or in tests another one; must outlive the judgement
    explicit Judgement(std::string_view bench, std::span<const Aim> aims = kAims);

    /// Record a figure, which must have an aim. Of several values the worst counts; NaN is worse than all.
    void record(std::string_view figure, double value);
    /// Excuse a figure that this run was asked not to measure.
    void leaveOut(std::string_view figure);
    /// Return a line for each aim, with "MISSED" or "NOT MEASURED" where it is not met.
    std::string describe() const;
    bool isMet() const;
    /// Print the lines.
    /// returns  exit code: 0, or 1 if an aim is missed or was not measured
    int finish() const;

private:
    std::string_view bench_;
    std::span<const Aim> aims_;
    std::map<std::string_view, double> values_; ///< by figure
    std::set<std::string_view> left_out_;       ///< figures that this run does not measure
};

} // namespace hearth::bench
