// The cost of a rendered frame: time, and bytes of memory.

#include "Stage.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>

static size_t Allocated = 0;

void* operator new(size_t Size)
{
	Allocated += Size;
	void* Block = std::malloc(Size);
	if (Block == nullptr) std::abort();
	return Block;
}

void operator delete(void* Block) noexcept { std::free(Block); }
void operator delete(void* Block, size_t) noexcept { std::free(Block); }

static void Measure(const char* Name, FStage& Stage, const TCHAR* Key, int Frames)
{
	Stage.Player->Begin(Key);
	Stage.Player->AdvanceTo(0.5f);
	const size_t Before = Allocated;
	const auto Start = std::chrono::steady_clock::now();
	for (int Frame = 0; Frame < Frames; Frame++) Stage.Player->AdvanceTo(0.5f + 0.5f * static_cast<float>(Frame) / static_cast<float>(Frames));
	const std::chrono::duration<double, std::nano> Time = std::chrono::steady_clock::now() - Start;
	const size_t Used = Allocated - Before;
	std::printf("bench %s_ns %.1f Unreal player\nbench %s_bytes %zu Unreal player\n", Name, Time.count() / Frames, Name, Used / Frames);
	EXPECT(Used == 0);
}

void TestFrames()
{
	const int Frames = 100000;
	FStage Visemes("drama", {"A", "E", "F", "L", "M", "O", "S", "U", "W"});
	Measure("tick", Visemes, TEXT("act1/mara-good-evening"), Frames);
	FStage Rig("rigs", {"jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "eyeBlinkLeft"});
	Rig.Player->Rig = TEXT("arkit");
	Measure("weights", Rig, TEXT("english"), Frames);
}
