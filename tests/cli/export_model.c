// SPDX-License-Identifier: MIT
// export_model MODEL FORMAT FILE: writes a model in one of the formats that Assimp writes, by its
// name for it.
#include <assimp/cexport.h>
#include <assimp/cimport.h>
#include <stdio.h>

int main(int count, char **words)
{
    if (count != 4)
        return 2;
    const struct aiScene *scene = aiImportFile(words[1], 0);
    if (scene == NULL || aiExportScene(scene, words[2], words[3], 0) != aiReturn_SUCCESS) {
        fprintf(stderr, "export_model: %s\n", aiGetErrorString());
        return 1;
    }
    aiReleaseImport(scene);
    return 0;
}
