/* A preloaded library that lets the n-th call of something fail, for the tests of what is left then. CLUES_FAULT is "CALL:N:HOW": CALL is open, read, write, rename, fsync, ftruncate,
   close, mkdir, unlink, rmdir, flock, mmap or malloc; HOW is ENOSPC, EIO, EACCES, ENOMEM, EINTR, SHORT (half of the bytes) or KILL. CLUES_FAULT_COUNTS names a file
   that gets the number of calls of each kind. It begins with main(), in that process alone: not in its children, nor in programs that it runs. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

enum call { OPEN, READ, WRITE, RENAME, FSYNC, FTRUNCATE, CLOSE, MKDIR, UNLINK, RMDIR, FLOCK, MMAP, MALLOC, CALLS };
static const char *const names[CALLS] = {"open",  "read",   "write", "rename", "fsync", "ftruncate", "close",
                                         "mkdir", "unlink", "rmdir", "flock",  "mmap",  "malloc"};
static atomic_long count[CALLS];
static atomic_int active;
static int failing = CALLS, how, is_short, is_kill;
static long at;
static char counts_file[4096];

static void *next(const char *name) { return dlsym(RTLD_NEXT, name); }

/* Whether this call is to fail; errno is set then. */
static int fails(enum call call) {
  if (!active) return 0;
  const long n = atomic_fetch_add(&count[call], 1) + 1;
  if ((int)call != failing || n != at) return 0;
  if (is_kill) syscall(SYS_kill, getpid(), SIGKILL);
  errno = how;
  return 1;
}

static void in_child(void) { active = 0; }

static void write_counts(void) {
  char text[1024];
  int size = 0;
  if (!active || counts_file[0] == 0) return;
  active = 0;
  for (int i = 0; i < CALLS; ++i) size += snprintf(text + size, sizeof text - (size_t)size, "%s %ld\n", names[i], count[i]);
  const int file = (int)syscall(SYS_openat, AT_FDCWD, counts_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (file < 0 || syscall(SYS_write, file, text, (size_t)size) != size) _exit(99);
}

static void begin(void) {
  const char *plan = getenv("CLUES_FAULT"), *counts = getenv("CLUES_FAULT_COUNTS");
  if (counts) snprintf(counts_file, sizeof counts_file, "%s", counts);
  if (plan) {
    char call[32], kind[32];
    if (sscanf(plan, "%31[a-z]:%ld:%31[A-Z]", call, &at, kind) != 3) _exit(98);
    for (int i = 0; i < CALLS; ++i) {
      if (strcmp(call, names[i]) == 0) failing = i;
    }
    is_short = strcmp(kind, "SHORT") == 0;
    is_kill = strcmp(kind, "KILL") == 0;
    how = strcmp(kind, "ENOSPC") == 0   ? ENOSPC
          : strcmp(kind, "EACCES") == 0 ? EACCES
          : strcmp(kind, "ENOMEM") == 0 ? ENOMEM
          : strcmp(kind, "EINTR") == 0  ? EINTR
                                        : EIO;
  }
  unsetenv("LD_PRELOAD");
  unsetenv("CLUES_FAULT");
  unsetenv("CLUES_FAULT_COUNTS");
  pthread_atfork(NULL, NULL, in_child);
  atexit(write_counts);
  active = 1;
}

static int (*real_main)(int, char **, char **);
static int started_main(int argc, char **argv, char **env) {
  begin();
  return real_main(argc, argv, env);
}

int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void *stack_end);
int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void *stack_end) {
  real_main = main;
  int (*start)(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void), void (*)(void), void *);
  *(void **)&start = next("__libc_start_main");
  return start(started_main, argc, argv, init, fini, rtld_fini, stack_end);
}

static int opened(int folder, const char *path, int flags, mode_t mode) {
  if (fails(OPEN)) return -1;
  return (int)syscall(SYS_openat, folder, path, flags, mode);
}
static mode_t mode_in(int flags, va_list *more) {
  return (flags & (O_CREAT | O_TMPFILE)) ? (mode_t)va_arg(*more, int) : 0;
}
#define OPEN_AT(name)                                            \
  int name(int folder, const char *path, int flags, ...) {       \
    va_list more;                                                \
    va_start(more, flags);                                       \
    const mode_t mode = mode_in(flags, &more);                   \
    va_end(more);                                                \
    return opened(folder, path, flags, mode);                    \
  }
#define OPEN_PATH(name)                                          \
  int name(const char *path, int flags, ...) {                   \
    va_list more;                                                \
    va_start(more, flags);                                       \
    const mode_t mode = mode_in(flags, &more);                   \
    va_end(more);                                                \
    return opened(AT_FDCWD, path, flags, mode);                  \
  }
OPEN_AT(openat)
OPEN_AT(openat64)
OPEN_PATH(open)
OPEN_PATH(open64)

static ssize_t in_part(enum call call, size_t *size) { /* -1: it fails */
  if (!fails(call)) return 0;
  if (!is_short) return -1;
  if (*size > 1) *size /= 2;
  return 0;
}
ssize_t read(int file, void *bytes, size_t size) {
  return in_part(READ, &size) < 0 ? -1 : syscall(SYS_read, file, bytes, size);
}
ssize_t write(int file, const void *bytes, size_t size) {
  if (file > 2 && in_part(WRITE, &size) < 0) return -1;
  return syscall(SYS_write, file, bytes, size);
}
#define AT_OFFSET(name, call, number, type)                                            \
  ssize_t name(int file, type bytes, size_t size, off_t offset) {                      \
    return in_part(call, &size) < 0 ? -1 : syscall(number, file, bytes, size, offset); \
  }
AT_OFFSET(pread, READ, SYS_pread64, void *)
AT_OFFSET(pread64, READ, SYS_pread64, void *)
AT_OFFSET(pwrite, WRITE, SYS_pwrite64, const void *)
AT_OFFSET(pwrite64, WRITE, SYS_pwrite64, const void *)

int rename(const char *from, const char *to) { return fails(RENAME) ? -1 : (int)syscall(SYS_rename, from, to); }
int fsync(int file) { return fails(FSYNC) ? -1 : (int)syscall(SYS_fsync, file); }
int fdatasync(int file) { return fails(FSYNC) ? -1 : (int)syscall(SYS_fdatasync, file); }
int ftruncate(int file, off_t size) { return fails(FTRUNCATE) ? -1 : (int)syscall(SYS_ftruncate, file, size); }
int ftruncate64(int file, off_t size) { return fails(FTRUNCATE) ? -1 : (int)syscall(SYS_ftruncate, file, size); }
int close(int file) { /* a close that fails has closed all the same */
  const int failed = fails(CLOSE), error = errno;
  const int result = (int)syscall(SYS_close, file);
  if (!failed) return result;
  errno = error;
  return -1;
}
int mkdir(const char *path, mode_t mode) { return fails(MKDIR) ? -1 : (int)syscall(SYS_mkdir, path, mode); }
int unlink(const char *path) { return fails(UNLINK) ? -1 : (int)syscall(SYS_unlink, path); }
int unlinkat(int folder, const char *path, int flags) {
  return fails(UNLINK) ? -1 : (int)syscall(SYS_unlinkat, folder, path, flags);
}
int rmdir(const char *path) { return fails(RMDIR) ? -1 : (int)syscall(SYS_rmdir, path); }
int flock(int file, int operation) { return fails(FLOCK) ? -1 : (int)syscall(SYS_flock, file, operation); }
void *mmap(void *where, size_t size, int protection, int flags, int file, off_t offset) {
  return fails(MMAP) ? MAP_FAILED : (void *)syscall(SYS_mmap, where, size, protection, flags, file, offset);
}
void *mmap64(void *where, size_t size, int protection, int flags, int file, off_t offset) {
  return fails(MMAP) ? MAP_FAILED : (void *)syscall(SYS_mmap, where, size, protection, flags, file, offset);
}

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void *malloc(size_t size) { return fails(MALLOC) ? NULL : __libc_malloc(size); }
void *calloc(size_t n, size_t size) { return fails(MALLOC) ? NULL : __libc_calloc(n, size); }
void *realloc(void *old, size_t size) { return fails(MALLOC) ? NULL : __libc_realloc(old, size); }
void *aligned_alloc(size_t alignment, size_t size) { return fails(MALLOC) ? NULL : __libc_memalign(alignment, size); }
