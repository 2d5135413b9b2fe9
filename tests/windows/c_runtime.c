/* What a C program of Visual Studio's ABI needs besides msvcrt.dll, where Microsoft's SDK is not at hand: its start,
 * and the standard streams by the name that headers use. */
typedef struct {
  char bytes[48];
} File; /* msvcrt.dll's FILE. */

File* __iob_func(void);
_Noreturn void exit(int code);
int main(void);

int _fltused = 1; /* The compiler asks for it wherever there are floating-point numbers. */

File* __acrt_iob_func(unsigned index) {
  return __iob_func() + index;
}

void start(void) {
  exit(main());
}
