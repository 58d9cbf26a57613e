#pragma once

// The arrays that a State has on the device, whether a team of threads advances it (state_team.cuh) or the whole GPU
// (grid/slots.cuh): X(type, name, how many, where a team has it). Members, accessors, layouts and allocation are all
// made from these tables, and those of what only one of the two has. `all` is one for each slot, and one more for the
// slot that is far from all others; `room` is what lists have room for, `size` the Model. An Index holds a slot, a
// particle's number or a count; a Word what cells hold.
//
// A team of threads that advances a State has its arrays on the chip of its one block (`team`), or in device memory,
// its scratch; a block of the team has some on its chip (`block_chip`).
#define NATATOR_CHIP_ARRAYS(X)                                             \
    /* By slot; w: inverse mass. Positions are read from these in turn. */ \
    X(Vec4<Real>, position, all, team)                                     \
    X(Vec4<Real>, scratch_position, room.scratch_position, team)           \
    /* Ends of the fluid's cells, then of the solids'. */                  \
    X(Word, table, room.cells, team)                                       \
    X(Index, slot_of_solid, size.solids, team)                             \
    X(ClusterFit<Real>, fit, size.clusters, team)

#define NATATOR_SCRATCH_ARRAYS(X)                                                                                    \
    /* Unsorted: in the order before slots are numbered, with inverse mass and number in w. */                       \
    X(Vec4<Real>, unsorted_position, room.unsorted, scratch)                                                         \
    X(Vec4<Real>, predicted_velocity, all, scratch) /* v* after external forces, by slot */                          \
    X(Vec4<Real>, unsorted_velocity, room.unsorted, scratch)                                                         \
    /* By slot; w of the start as in position. */                                                                    \
    X(Vec4<Real>, start, all, scratch)                                                                               \
    X(Index, number, all, scratch)                                                                                   \
    X(uint4, neighbour, room.neighbours, scratch) /* fluid neighbours of fluid slots, in chunks */                   \
    X(Index, neighbour_count, room.neighbour_counts, scratch)                                                        \
    /* Entry k of fluid slot s at [k * fluid + s], of a solid's at [k * solids + s - fluid]. */                      \
    X(Index, fluid_contact, room.fluid_contacts, scratch)                                                            \
    X(Index, solid_contact, room.solid_contacts, scratch)                                                            \
    X(Index, contact_count, all, scratch)                                                                            \
    X(Index, plane_contact, all, scratch)                    /* bit k: plane k may be touched in this substep */     \
    X(Index, contact_slots, room.contact_slots, scratch)     /* slots that have contacts, in no order */             \
    X(Vec4<Real>, contact_push, room.contact_slots, scratch) /* by slot; w: how many contacts */                     \
    /* Where an effect needs them. */                                                                                \
    X(Real, density, plan.fluid&& plan.free_surface_drag ? all : 0, scratch) /* in units of rest density */          \
    X(Real, overlaps, plan.dissipation ? all : 0, scratch)                   /* contacts that are, when predicted */ \
    X(Vec4<Real>, normal, plan.fluid&& plan.surface_tension ? all : 0, scratch)                                      \
    X(Vec4<Real>, curl, plan.fluid&& plan.vorticity ? all : 0, scratch)

// What only such a team has.
#define NATATOR_TEAM_ONLY_ARRAYS(X)                  \
    X(Real, rest_length, size.springs, team)         \
    X(SharedByBlock, shared_by_block, 1, block_chip) \
    X(SharedByTeam<Real>, shared_by_team, 1, team)   \
    X(Vec4<Real>, scratch_velocity, all, scratch)    \
    X(Vec4<Real>, unsorted_start, all, scratch)      \
    X(ClusterFit<Real>, fit_before, size.clusters, scratch)

// Of the block that has the solids on its chip, see solids_on_chip.cuh; shares in the Model's order.
#define NATATOR_CHIP_SOLID_ARRAYS(X)                                                             \
    X(Vec4<Real>, chip_solid, room.solids, block_chip)        /* where it is; w: inverse mass */ \
    X(int, chip_springs_begin, room.solid_bounds, block_chip) /* of its shares, by solid */      \
    X(int, chip_members_begin, room.solid_bounds, block_chip)                                    \
    X(ChipSpring<Real>, chip_spring, room.spring_incidences, block_chip)                         \
    X(Incidence, chip_member_incidence, room.members, block_chip)                                \
    X(Vec4<Real>, chip_member, room.members, block_chip) /* rest offset; w: solid id */          \
    X(ClusterView<Real>, chip_cluster, room.clusters, block_chip)                                \
    X(ClusterFit<Real>, chip_fit, room.clusters, block_chip)

// Of each block of a team whose threads share slots, see shared_slots.cuh: what it reads in every iteration.
#define NATATOR_SHARED_SLOT_ARRAYS(X)                                                                          \
    X(Index, rank, room.ranks, scratch)              /* among its cell's, by slot before */                    \
    X(Index, searched, room.ranks, scratch)          /* fluid that may have contacts, in no order */           \
    X(Word, chip_table, room.chip_cells, block_chip) /* ends of all cells */                                   \
    X(Index, chip_neighbour, max_listed_on_chip* room.chip_slots,                                              \
      block_chip) /* of its own fluid slots, the first of each */                                              \
    X(Index, chip_neighbour_count, room.chip_slots, block_chip)                                                \
    X(Index, chip_contact, max_listed_on_chip* room.chip_contact_slots,                                        \
      block_chip)                                                     /* of its own contact slots, likewise */ \
    X(Index, chip_contact_slots, room.chip_contact_slots, block_chip) /* which they are */                     \
    X(Index, chip_contact_count, room.chip_contact_slots, block_chip)

// Their order is that of the offsets which the kernel keeps in registers: in another it is 1.6 % slower on an H100.
#define NATATOR_TEAM_ARRAYS(X)  \
    NATATOR_CHIP_ARRAYS(X)      \
    NATATOR_TEAM_ONLY_ARRAYS(X) \
    NATATOR_SCRATCH_ARRAYS(X)   \
    X(Index, own_staging, room.staging, block_chip) NATATOR_CHIP_SOLID_ARRAYS(X) NATATOR_SHARED_SLOT_ARRAYS(X)
