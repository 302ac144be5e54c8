/* Lists that grow, and the queue of coming events: a heap ordered by cycle, then by arrival. */
#include <stdlib.h>
#include <string.h>

#include "rig.h"

void record_add(record_t *record, const void *item, size_t size) {
    if (record->count == record->room) {
        record->room = record->room ? record->room * 2 : 256;
        record->items = realloc(record->items, record->room * size);
    }
    memcpy((char *)record->items + record->count++ * size, item, size);
}

static bool is_before(const event_t *one, const event_t *other) {
    return one->cycle != other->cycle ? one->cycle < other->cycle : one->order < other->order;
}

void queue_add(queue_t *queue, cycle_t cycle, uint8_t kind, uint8_t a, uint8_t b) {
    if (queue->count == queue->room) {
        queue->room = queue->room ? queue->room * 2 : 64;
        queue->items = realloc(queue->items, queue->room * sizeof(event_t));
    }
    event_t event = {cycle, queue->order++, kind, a, b};
    size_t at = queue->count++;
    while (at && is_before(&event, &queue->items[(at - 1) / 2])) {
        queue->items[at] = queue->items[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    queue->items[at] = event;
}

event_t queue_take(queue_t *queue) {
    event_t first = queue->items[0], last = queue->items[--queue->count];
    size_t at = 0;
    for (;;) {
        size_t child = 2 * at + 1;
        if (child >= queue->count) break;
        if (child + 1 < queue->count && is_before(&queue->items[child + 1], &queue->items[child]))
            child++;
        if (!is_before(&queue->items[child], &last)) break;
        queue->items[at] = queue->items[child];
        at = child;
    }
    queue->items[at] = last;
    return first;
}
