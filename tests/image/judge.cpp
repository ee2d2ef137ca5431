// SPDX-License-Identifier: MIT
// judge PICTURE PICTURE THRESHOLD1 THRESHOLD4: prints OpenImageIO's comparison of two files as
// JSON. A pixel fails or warns if a channel differs by more than the threshold.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <cstdio>
#include <cstdlib>

int main(int count, char **words)
{
    if (count != 5)
        return 2;
    OIIO::ImageBuf first(words[1]), second(words[2]);
    if (!first.read(0, 0, true, OIIO::TypeDesc::FLOAT) ||
        !second.read(0, 0, true, OIIO::TypeDesc::FLOAT))
        return 3;
    const auto result = OIIO::ImageBufAlgo::compare(first, second, float(std::atof(words[4])),
                                                    float(std::atof(words[3])));
    std::printf("{\"rmse\": %.17g, \"psnr\": %.17g, \"maximum\": %.17g, "
                "\"off_by_1\": %lld, \"off_by_4\": %lld}\n",
                result.rms_error, result.PSNR, result.maxerror, (long long)result.nwarn,
                (long long)result.nfail);
    return 0;
}
