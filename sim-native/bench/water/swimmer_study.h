#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "result_table.h"
#include "water/water_case.h"

namespace natator::bench {

/// Swimmers of imposed motion under several settings.
struct SwimmerStudy {
    std::vector<std::string> cases;  ///< as read_swim_case takes them
    std::vector<int> resolutions;    ///< particles or cells along the body
    std::vector<Setting> settings;   ///< of scheme conserving; none: without it
    std::vector<double> supports;
    std::vector<double> boxes{1};  ///< size of the box, of the usual one
    /// at the middle of the box, by gravity: enough for the water to follow the tail; density (length/beat)^2
    std::vector<double> pressures{2.5};
    std::vector<int> starts{1};
    std::vector<double> machs{};  ///< of 1.2 lengths a beat, of water on a lattice; none: without it
    int beats = 8, counted = 3;   ///< counted: at the end
    std::optional<int> gpu{};     ///< its number; none: on the CPU
    bool quick = false;           ///< only the first variant of each case
};

/// Columns case, variant, resolution, box, pressure, beats, scheme, precision, backend, substeps, iterations,
/// modified_pressure, support, start, mach (these are the key; empty: not of this scheme); status (ok, unstable, too
/// viscous: for an explicit substep of that length); across (particles or cells across the body where it is widest, as
/// the file has it); steps (substeps, or steps of the lattice, in a beat); swim_quantities(): speed (lengths/beat, mean
/// of the counted beats, forwards), spread (their standard deviation), lateral (speed to the side), slip (speed over
/// that of the wave), tail_beat (from side to side, lengths), strouhal, reynolds, swimming_number (pi tail_beat times
/// length over viscosity), amplitude (the scale), force (forwards), power (given to the water), pressure (the part of
/// the force along the surface's normal; the rest is friction) and thrust (mean of what of pressure and friction is
/// above 0: Borazjani, Sotiropoulos 2008; both on a lattice only), in densities of water, lengths and beats, of a slab
/// for a length of span; then particles (or cells); run_time (s); reference, deviation (of it), met, confirmed: of the
/// first target of this variant's alone.
Row swimmer_columns();
inline constexpr std::size_t swimmer_key_columns = 15;

/// The key; beat; speed, lateral, force, power.
Row swimmer_beat_columns();

/// Runs what `table` does not hold yet; `report` gets a line per row. Throws InputError, before anything is run, for a
/// file that is wrong.
void run_swimmer_study(const SwimmerStudy& study, ResultTable& table, ResultTable& beats,
                       const std::function<void(const std::string&)>& report);

/// All targets of these cases, and of those that come with the program, beside what the rows give: the key, variant
/// "all" for a target of several, which waits for two of them; quantity, over, zero_of; value, least, greatest,
/// reference, deviation, met, confirmed.
ResultTable swimmer_targets(const SwimmerStudy& study, const ResultTable& table);

}  // namespace natator::bench
