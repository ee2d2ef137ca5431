// SPDX-License-Identifier: MIT
// export_model MODEL FORMAT FILE: uses Assimp to convert MODEL to FILE. FORMAT is Assimp's name of
// FILE's format. Without arguments, export_model prints the file endings that Assimp reads.
#include <assimp/cexport.h>
#include <assimp/cimport.h>
#include <assimp/importerdesc.h>
#include <stdio.h>

static int tell_endings(void)
{
    for (size_t i = 0; i < aiGetImportFormatCount(); i++)
        puts(aiGetImportFormatDescription(i)->mFileExtensions);
    return 0;
}

static int export_model(const char *model, const char *format, const char *path)
{
    const struct aiScene *scene = aiImportFile(model, 0);
    if (scene == NULL || aiExportScene(scene, format, path, 0) != aiReturn_SUCCESS) {
        fprintf(stderr, "export_model: %s\n", aiGetErrorString());
        return 1;
    }
    aiReleaseImport(scene);
    return 0;
}

int main(int count, char **words)
{
    if (count == 1)
        return tell_endings();
    return count == 4 ? export_model(words[1], words[2], words[3]) : 2;
}
