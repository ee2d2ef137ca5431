// SPDX-License-Identifier: MIT
// Whole messages between two processes over a pair of sockets.
#pragma once

#include <stdbool.h>
#include <stddef.h>

// Return false if the other process has closed its socket.
bool socket_send(int socket, const void *bytes, size_t size);
bool socket_receive(int socket, void *bytes, size_t size);
