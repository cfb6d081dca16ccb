#include "LipzWeights.h"

#include "LipzStrings.h"

bool FLipzWeights::Begin(const FLipzDialogue& Dialogue, const lipz_clip& Clip, const FString& InRigName)
{
	Names.Reset();
	Thousandths.Reset();
	Codes.Reset();
	BeginRig(Dialogue, InRigName);
	if (!bHasRig)
	{
		BeginVisemes(Clip);
	}
	BeginCurves(Dialogue, Clip);
	Values.Init(0.0f, Names.Num());
	return bHasRig;
}

void FLipzWeights::BeginRig(const FLipzDialogue& Dialogue, const FString& InRigName)
{
	RigName = InRigName;
	bHasRig = Dialogue.FindRig(RigName, Rig);
	if (!bHasRig)
	{
		return;
	}
	lipz_string Name;
	for (uint32 Index = 0; lipz_rig_weight_name(Dialogue.Get(), &Rig, Index, &Name) == LIPZ_OK; Index++)
	{
		Names.Add(LipzStrings::ToFName(Name));
	}
	Thousandths.Init(0, Names.Num());
}

void FLipzWeights::BeginVisemes(const lipz_clip& Clip)
{
	const ANSICHAR* All = Clip.viseme_type == LIPZ_TOONBOOM ? "ABCDEFG-" : Clip.viseme_type == LIPZ_RMS ? "0123456789-" : "AEFLMOSUW-";
	for (; *All != '\0'; All++)
	{
		Codes.Add(static_cast<uint8>(*All));
		Names.Add(*All == '-' ? FName(TEXT("rest")) : LipzStrings::ToFName({All, 1}));
	}
}

void FLipzWeights::BeginCurves(const FLipzDialogue& Dialogue, const lipz_clip& Clip)
{
	Curves.Reset();
	CurveCursors.Reset();
	lipz_curve Curve;
	for (uint32 Index = 0; lipz_clip_curve_by_index(Dialogue.Get(), &Clip, Index, &Curve) == LIPZ_OK; Index++)
	{
		const FName Name = LipzStrings::ToFName(Curve.name);
		if (!Names.Contains(Name))
		{
			Names.Add(Name);
			Curves.Add(Index);
			CurveCursors.Add({0});
		}
	}
}

void FLipzWeights::UpdateRig(const FLipzDialogue& Dialogue, const lipz_clip& Clip, lipz_time Time, const lipz_who& Who)
{
	lipz_articulation Articulation;
	lipz_emotions Emotions;
	lipz_face Face;
	lipz_clip_articulation_at(Dialogue.Get(), &Clip, Time, nullptr, &Articulation);
	lipz_clip_emotions_at(Dialogue.Get(), &Clip, Time, &Who, &Emotions);
	lipz_clip_face_at(Dialogue.Get(), &Clip, Time, &Who, nullptr, nullptr, &Face);
	const size_t Count = static_cast<size_t>(Thousandths.Num());
	const auto Compute = [&] { return lipz_rig_weights(Dialogue.Get(), &Rig, &Articulation, &Emotions, &Face, Thousandths.GetData(), Count); };
	// A rig belongs to one version of the bank.
	if (Compute() != LIPZ_OK && Dialogue.FindRig(RigName, Rig))
	{
		Compute();
	}
}

void FLipzWeights::Update(const FLipzDialogue& Dialogue, const lipz_clip& Clip, lipz_time Time, uint8 Viseme, const lipz_who& Who)
{
	int32 Next = 0;
	if (bHasRig)
	{
		UpdateRig(Dialogue, Clip, Time, Who);
	}
	for (const int32 Weight : Thousandths)
	{
		Values[Next++] = static_cast<float>(Weight) / 1000.0f;
	}
	for (const uint8 Code : Codes)
	{
		Values[Next++] = Code == Viseme ? 1.0f : 0.0f;
	}
	for (int32 Index = 0; Index < Curves.Num(); Index++)
	{
		lipz_curve Curve;
		int32_t Value = 0;
		if (lipz_clip_curve_by_index(Dialogue.Get(), &Clip, Curves[Index], &Curve) == LIPZ_OK)
		{
			lipz_curve_value_at(Dialogue.Get(), &Curve, Time, &CurveCursors[Index], &Value);
		}
		Values[Next++] = static_cast<float>(Value) / 1000.0f;
	}
}

void FLipzWeights::Rest()
{
	for (float& Value : Values)
	{
		Value = 0.0f;
	}
}
