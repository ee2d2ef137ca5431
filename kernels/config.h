// SPDX-License-Identifier: MIT
// The switches that specialize a program. The kernels test most of them with a plain `if`, and the
// optimizer removes unused features. With the defaults, a program renders every scene without
// glass. A general program (traits_general in host/accel/traits.h) omits glass if the scene has
// none. It also omits checkers if the scene has neither checkers nor glass. The first group
// describes the scene and enables counting (host/accel/traits.c).
#ifndef CLRT_CONFIG_H
#define CLRT_CONFIG_H

#ifndef CLRT_SPHERES
#define CLRT_SPHERES 1 // the scene has spheres
#endif
#ifndef CLRT_TRIANGLES
#define CLRT_TRIANGLES 1 // the scene has triangles
#endif
#ifndef CLRT_BVH
#define CLRT_BVH 1 // rays find triangles, or spheres with wide nodes, by trees (0: they test all)
#endif
#ifndef CLRT_MIRRORS
#define CLRT_MIRRORS 1 // a used material reflects
#endif
#ifndef CLRT_SHADED
#define CLRT_SHADED 1 // a used material is shaded by lights
#endif
#ifndef CLRT_COLORS
#define CLRT_COLORS 1 // a mesh has vertex colors
#endif
#ifndef CLRT_CHECKERS
#define CLRT_CHECKERS 1 // a used material has a checker
#endif
#ifndef CLRT_GLASS
#define CLRT_GLASS 0 // a used material is glass
#endif
#ifndef CLRT_STATISTICS
#define CLRT_STATISTICS 0 // rays and tests are counted
#endif

#define CLRT_TALLIES (CLRT_STATISTICS || CLRT_GLASS)              // the kernels store tallies
#define TALLY_STORED (TALLY_KINDS - TALLY_FIRST(CLRT_STATISTICS)) // the number of kinds stored

// The form of the kernels, set by kernel_choice.c, program.c and KernelEntry (all in host/device).
#ifndef CLRT_WIDE_NODES
#define CLRT_WIDE_NODES 0 // BvhWide and TriangleBlock replace BvhPair and TriangleData
#endif
#ifndef CLRT_PACKET
#define CLRT_PACKET 0 // packets of rays search together (0: ray by ray)
#endif
#ifndef CLRT_PLACES
#define CLRT_PLACES 0 // requests are places of single samples (SamplePlace)
#endif
#ifndef CLRT_RAYS
#define CLRT_RAYS 0 // the program traces arrays of rays (rays.cl)
#endif
#ifndef CLRT_ALL_HITS
#define CLRT_ALL_HITS 0 // the program finds all hits of a ray (crossings.cl)
#endif
#ifndef CLRT_GPU
#define CLRT_GPU 0 // fp32 on a device that is not a CPU: single rays keep their state in registers
#endif
#ifndef CLRT_FP64
#define CLRT_FP64 0 // Real is double: one ray per work-item, pair nodes
#endif

#endif
