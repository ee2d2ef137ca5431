// SPDX-License-Identifier: MIT
// Computes the operations on which all pictures depend. host/device/arithmetic.c compares the
// results with results of the host, bit by bit. The kernel is compiled after render.cl, which
// forbids contraction.

// Each case has three operands. For each case, `results` receives one word per operation, in the
// host's order.
kernel void repeat_arithmetic(global const float *cases, global uint *results)
{
    const size_t item = get_global_id(0);
    const float a = cases[3 * item], b = cases[3 * item + 1], c = cases[3 * item + 2];
    global uint *words = results + 12 * item;
    words[0] = as_uint(a + b);
    words[1] = as_uint(a - b);
    words[2] = as_uint(a * b);
    words[3] = as_uint(a * b + c);
    words[4] = as_uint(fma(a, b, c));
    words[5] = as_uint(a / b);
    words[6] = as_uint(sqrt(fabs(a)));
    words[7] = as_uint(min(max(a, b), c));
    words[8] = as_uint(rint(a));
    words[9] = as_uint(convert_float((ulong)as_uint(a) << 32 | as_uint(b)));
    words[10] = (uint)convert_ulong(fabs(a) < 0x1p31f ? fabs(a) : 1.0f);
    words[11] = (a < b ? 1 : 0) | (a <= c ? 2 : 0) | (a == -b ? 4 : 0);
}
