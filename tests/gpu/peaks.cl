// SPDX-License-Identifier: MIT
// Kernels that only read memory, or only multiply and add.

kernel void read_memory(global const float4 *values, uint count, global float *sums)
{
    float4 sum = 0.0f;
    for (uint i = get_global_id(0); i < count; i += get_global_size(0))
        sum += values[i];
    sums[get_global_id(0)] = sum.x + sum.y + sum.z + sum.w;
}

// Each work-item computes 2 * 8 * `count` operations, in 8 independent chains.
kernel void multiply_and_add(global const float4 *values, uint count, global float *sums)
{
    float8 chain = (float8)(values[0], values[1]) + (float)get_global_id(0);
    for (uint i = 0; i < count; i++)
        chain = fma(chain, (float8)(0.9999f), (float8)(1e-4f));
    sums[get_global_id(0)] =
        chain.s0 + chain.s1 + chain.s2 + chain.s3 + chain.s4 + chain.s5 + chain.s6 + chain.s7;
}
