// SPDX-License-Identifier: MIT
// Signals and full buffers interrupt transfers. These functions repeat send and recv until all
// bytes are transferred.
#include "image/socket.h"

#include <errno.h>
#include <sys/socket.h>

bool socket_send(int socket, const void *bytes, size_t size)
{
    const char *next = bytes;
    while (size > 0) {
        const ssize_t sent = send(socket, next, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return false;
        next += sent;
        size -= (size_t)sent;
    }
    return true;
}

bool socket_receive(int socket, void *bytes, size_t size)
{
    char *next = bytes;
    while (size > 0) {
        const ssize_t received = recv(socket, next, size, 0);
        if (received < 0 && errno == EINTR)
            continue;
        if (received <= 0)
            return false;
        next += received;
        size -= (size_t)received;
    }
    return true;
}
