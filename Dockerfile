# SPDX-License-Identifier: MIT
# clrt on PoCL, for any CPU:
#   docker build -t clrt .
#   docker run --rm -v "$PWD:/work" -u "$(id -u)" clrt scenes/simple.scn -o simple.png
# The folder with the scenes is /work. The image has neither a window nor OpenImageIO, so it writes
# PNG, EXR and PFM; Assimp reads meshes in other formats than PLY.
FROM debian:bookworm-slim AS build
COPY . /src
WORKDIR /src
RUN tools/setup meshes \
    && cmake --preset release -DCLRT_WITH_MODELS=OFF -DCLRT_WITH_LIBRARY=OFF -DCMAKE_INSTALL_PREFIX=/usr \
    && cmake --build --preset release --target installable \
    && DESTDIR=/out cmake --install build/release --strip

FROM debian:bookworm-slim
RUN apt-get update \
    && apt-get install -y --no-install-recommends \
        pocl-opencl-icd ocl-icd-libopencl1 libpng16-16 libjansson4 libxxhash0 libopenexr-3-1-30 libdeflate0 \
        libassimp5 \
    && apt-get clean && rm -rf /var/lib/apt/lists/*
COPY --from=build /out /
# Compiled kernels, which any user may add to.
ENV POCL_CACHE_DIR=/var/cache/clrt
RUN mkdir -m 1777 $POCL_CACHE_DIR && clrt warm && chmod -R a+rwX $POCL_CACHE_DIR
WORKDIR /work
USER nobody
ENTRYPOINT ["clrt"]
