// The events, subtitles and face of a player.

#include "Components/SkeletalMeshComponent.h"
#include "GameFramework/Actor.h"
#include "Internationalization/Culture.h"
#include "Internationalization/Internationalization.h"
#include "Internationalization/StringTable.h"
#include "Internationalization/StringTableCore.h"
#include "LipzBank.h"
#include "LipzDialogue.h"
#include "LipzLog.h"
#include "LipzMorphTargets.h"
#include "LipzPlayback.h"
#include "LipzPlayerComponent.h"
#include "LipzStrings.h"
#include "LipzWeights.h"

bool ULipzPlayerComponent::ShowAt(double Seconds)
{
	const uint32 Line = LineNumber;
	if (const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue())
	{
		Playback->AdvanceTo(*Dialogue, lipz_time_seconds(Seconds));
	}
	if (!HandleEvents())
	{
		return false;
	}
	ShowSubtitle();
	if (LineNumber != Line)
	{
		return false;
	}
	ShowFace(Seconds);
	return true;
}

bool ULipzPlayerComponent::HandleEvents()
{
	const uint32 Line = LineNumber;
	FLipzEvent Event;
	// A handler may replace the bank, or start a clip.
	while (LineNumber == Line)
	{
		const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
		if (!Dialogue.IsValid() || !Playback->TakeEvent(*Dialogue, Event))
		{
			return true;
		}
		OnEvent.Broadcast(Event);
	}
	return false;
}

void ULipzPlayerComponent::ShowSubtitle()
{
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	lipz_segment Segment;
	const bool bHasSegment = Dialogue.IsValid() && Playback->FindSegment(*Dialogue, Segment);
	const int64 Index = bHasSegment ? static_cast<int64>(Segment.index) : -1;
	if (Index == ShownSegment)
	{
		return;
	}
	ShownSegment = Index;
	SetSubtitle(bHasSegment ? FindSubtitle(Segment.index) : FText());
}

void ULipzPlayerComponent::SetSubtitle(const FText& NewSubtitle)
{
	if (!Subtitle.IsEmpty() || !NewSubtitle.IsEmpty())
	{
		Subtitle = NewSubtitle;
		OnSubtitle.Broadcast(Subtitle);
	}
}

FText ULipzPlayerComponent::FindSubtitle(uint32 SegmentIndex) const
{
	if (SubtitleTable != nullptr)
	{
		// A clip with a single segment has an entry without a number.
		const FString Numbered = FString::Printf(TEXT("%s|%u"), *PlayingKey, SegmentIndex + 1);
		for (const FString& Key : {Numbered, PlayingKey})
		{
			FString Source;
			if ((SegmentIndex == 0 || Key == Numbered) && SubtitleTable->GetStringTable()->GetSourceString(FTextKey(Key), Source))
			{
				return FText::FromStringTable(SubtitleTable->GetStringTableId(), Key);
			}
		}
	}
	return PlayingBank->GetText(PlayingKey, static_cast<int32>(SegmentIndex), Locale);
}

void ULipzPlayerComponent::SetLocale(const FString& NewLocale)
{
	Locale = NewLocale;
	if (bIsPlaying)
	{
		ShownSegment = -1;
		ShowSubtitle();
	}
}

void ULipzPlayerComponent::BeginFace()
{
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	lipz_clip Clip;
	if (!Dialogue.IsValid() || !Playback->FindClip(*Dialogue, Clip))
	{
		return;
	}
	if (!Weights->Begin(*Dialogue, Clip, Rig) && !Rig.IsEmpty())
	{
		UE_LOG(LogLipz, Warning, TEXT("%s: the bank has no rig \"%s\": add %s = true to [rig] in lipz.toml, and pack again"),
			*GetPathName(), *Rig, *Rig);
	}
	WeightsByName.Reset();
	for (const FName Name : Weights->GetNames())
	{
		WeightsByName.Add(Name, 0.0f);
	}
	FindFace();
	const TArray<FName> Missing = FaceTargets->Find(PlayingFace, Weights->GetNames(), MorphTargets);
	if (PlayingFace != nullptr && Missing.Num() > 0)
	{
		UE_LOG(LogLipz, Log, TEXT("%s: %d of %d weights have no morph target, such as %s"), *GetPathName(), Missing.Num(),
			Weights->GetNames().Num(), *Missing[0].ToString());
	}
}

void ULipzPlayerComponent::FindFace()
{
	USkeletalMeshComponent* Found = Face;
	if (Found == nullptr && GetOwner() != nullptr)
	{
		int32 Most = 0;
		TArray<USkeletalMeshComponent*> Meshes;
		GetOwner()->GetComponents(Meshes);
		for (USkeletalMeshComponent* Mesh : Meshes)
		{
			FaceTargets->Find(Mesh, Weights->GetNames(), MorphTargets);
			if (FaceTargets->Num() > Most)
			{
				Most = FaceTargets->Num();
				Found = Mesh;
			}
		}
	}
	if (Found != nullptr && Found != PlayingFace)
	{
		Found->AddTickPrerequisiteComponent(this); // so that the mesh shows the weights of this frame
	}
	PlayingFace = Found;
}

void ULipzPlayerComponent::ShowFace(double Seconds)
{
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	lipz_clip Clip;
	if (!Dialogue.IsValid() || Playback->IsOver() || !Playback->FindClip(*Dialogue, Clip))
	{
		Rest();
		return;
	}
	Weights->Update(*Dialogue, Clip, lipz_time_seconds(Seconds), Playback->GetViseme(*Dialogue), Playback->GetSpeaker());
	ApplyWeights();
	bIsAtRest = false;
}

void ULipzPlayerComponent::Rest()
{
	if (!bIsAtRest)
	{
		bIsAtRest = true;
		Weights->Rest();
		ApplyWeights();
	}
}

void ULipzPlayerComponent::ApplyWeights()
{
	for (int32 Index = 0; Index < Weights->GetNames().Num(); Index++)
	{
		WeightsByName.FindOrAdd(Weights->GetNames()[Index]) = Weights->GetValues()[Index];
	}
	if (IsValid(PlayingFace.Get()))
	{
		FaceTargets->Show(PlayingFace, Weights->GetValues());
	}
}

FString ULipzPlayerComponent::GetViseme() const
{
	const TSharedPtr<FLipzDialogue> Dialogue = GetDialogue();
	if (bIsAtRest || !Dialogue.IsValid())
	{
		return TEXT("-");
	}
	const char Code = static_cast<char>(Playback->GetViseme(*Dialogue));
	return LipzStrings::ToFString({&Code, 1});
}

float ULipzPlayerComponent::GetWeight(FName Name) const
{
	const float* Weight = WeightsByName.Find(Name);
	return Weight != nullptr ? *Weight : 0.0f;
}
