// Settings that jemalloc reads as the program starts. A bed's arrays are walked through in every step and looked up
// from contact to contact: in large pages, where the system has them, the processor finds their addresses at once.
// Large blocks are kept when they are freed, since the lists of neighbours take the next ones soon.

extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always,oversize_threshold:0";
}
