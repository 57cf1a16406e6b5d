/* The one function of bcryptprimitives.dll that Rust programs need. Wine 8 lacks this part of Windows. */
#include <windows.h>
#include <ntsecapi.h>

__declspec(dllexport) BOOL WINAPI ProcessPrng(BYTE *bytes, SIZE_T size)
{
    return RtlGenRandom(bytes, (ULONG)size);
}
