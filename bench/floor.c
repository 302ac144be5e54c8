/* The floor of the latency figures: epoll, read, write the same bytes back on a serial port.
 *
 * usage: floor PORT [REALTIME_PRIORITY]. Ends when the port does.
 */
#define _GNU_SOURCE
#include <fcntl.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/epoll.h>
#include <termios.h>
#include <unistd.h>

static int fail(const char *what)
{
    perror(what);
    return 1;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: floor PORT [REALTIME_PRIORITY]\n");
        return 2;
    }
    if (argc > 2) {
        struct sched_param priority = {.sched_priority = atoi(argv[2])};
        if (sched_setscheduler(0, SCHED_FIFO, &priority) != 0)
            return fail("SCHED_FIFO");
    }
    int port = open(argv[1], O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (port < 0)
        return fail(argv[1]);
    struct termios raw;
    if (tcgetattr(port, &raw) != 0)
        return fail("tcgetattr");
    cfmakeraw(&raw);
    if (tcsetattr(port, TCSANOW, &raw) != 0)
        return fail("tcsetattr");
    int poll = epoll_create1(0);
    struct epoll_event wanted = {.events = EPOLLIN}, happened;
    if (poll < 0 || epoll_ctl(poll, EPOLL_CTL_ADD, port, &wanted) != 0)
        return fail("epoll");
    if (write(port, "", 1) != 1) /* the zero that opens the line */
        return fail("write");
    char bytes[4096];
    while (epoll_wait(poll, &happened, 1, -1) >= 0) {
        ssize_t count = read(port, bytes, sizeof bytes);
        if (count <= 0 || write(port, bytes, (size_t)count) != count)
            return 0;
    }
    return 0;
}
