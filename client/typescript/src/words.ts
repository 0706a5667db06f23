// Words for the contract's enums, as in result.json and on the command line: the wire's names in
// lower case and without their prefix. FIT_MODE_BEST_FIT is "best_fit".
import { invalidField } from "./errors";
import { BodyPart as BodyPartName } from "./generated/capfit/v1/BodyPart";
import { BodyPartGroup as BodyPartGroupName } from "./generated/capfit/v1/BodyPartGroup";
import { Bone as BoneName } from "./generated/capfit/v1/Bone";
import { CapsuleProfile as CapsuleProfileName } from "./generated/capfit/v1/CapsuleProfile";
import { FitMode as FitModeName } from "./generated/capfit/v1/FitMode";
import { LandmarkMethod as LandmarkMethodName } from "./generated/capfit/v1/LandmarkMethod";
import { LengthUnit as LengthUnitName } from "./generated/capfit/v1/LengthUnit";
import { MeshFileFormat as MeshFileFormatName } from "./generated/capfit/v1/MeshFileFormat";
import { MeshPartKind as MeshPartKindName } from "./generated/capfit/v1/MeshPartKind";
import { Quality as QualityName } from "./generated/capfit/v1/Quality";
import { Sex as SexName } from "./generated/capfit/v1/Sex";
import { SkinningForm as SkinningFormName } from "./generated/capfit/v1/SkinningForm";
import { Stage as StageName } from "./generated/capfit/v1/Stage";
import { UpAxis as UpAxisName } from "./generated/capfit/v1/UpAxis";

type WordOf<Name, Prefix extends string> = Name extends `${Prefix}_${infer Rest}`
  ? Rest extends "UNSPECIFIED"
    ? never
    : Lowercase<Rest>
  : never;

// The words of one enum. UNSPECIFIED has none.
class Vocabulary<Word extends string, Name extends string> {
  readonly words: readonly Word[];

  constructor(
    names: Readonly<Record<string, Name>>,
    private readonly prefix: string,
  ) {
    this.words = Object.keys(names)
      .map((name) => this.strip(name))
      .filter((word) => word !== "unspecified") as Word[];
  }

  // The wire's name. proto-loader would send the default for a word that it does not know.
  toWire(word: unknown, field: string): Name {
    if (!(this.words as readonly unknown[]).includes(word)) {
      const limit = this.words.join(", ");
      throw invalidField("UNKNOWN_VALUE", field, `must be one of ${limit}`, word, limit);
    }
    return `${this.prefix}_${(word as Word).toUpperCase()}` as Name;
  }

  // null: unspecified. The number of a value that only later versions know becomes its digits.
  fromWire(name: Name): Word | null {
    const word = this.strip(String(name));
    return word === "unspecified" ? null : (word as Word);
  }

  private strip(name: string): string {
    return (name.startsWith(`${this.prefix}_`) ? name.slice(this.prefix.length + 1) : name)
      .toLowerCase();
  }
}

function vocabulary<Name extends string, Prefix extends string>(
  names: Readonly<Record<string, Name>>,
  prefix: Prefix,
): Vocabulary<WordOf<Name, Prefix>, Name> {
  return new Vocabulary(names, prefix);
}

export const bodyParts = vocabulary(BodyPartName, "BODY_PART");
export const bodyPartGroups = vocabulary(BodyPartGroupName, "BODY_PART_GROUP");
export const bones = vocabulary(BoneName, "BONE");
export const capsuleProfiles = vocabulary(CapsuleProfileName, "CAPSULE_PROFILE");
export const fitModes = vocabulary(FitModeName, "FIT_MODE");
export const landmarkMethods = vocabulary(LandmarkMethodName, "LANDMARK_METHOD");
export const lengthUnits = vocabulary(LengthUnitName, "LENGTH_UNIT");
export const meshFileFormats = vocabulary(MeshFileFormatName, "MESH_FILE_FORMAT");
export const meshPartKinds = vocabulary(MeshPartKindName, "MESH_PART_KIND");
export const qualities = vocabulary(QualityName, "QUALITY");
export const sexes = vocabulary(SexName, "SEX");
export const skinningForms = vocabulary(SkinningFormName, "SKINNING_FORM");
export const stages = vocabulary(StageName, "STAGE");
export const upAxes = vocabulary(UpAxisName, "UP_AXIS");

/** A part of the body, left and right apart. */
export type BodyPart = (typeof bodyParts.words)[number];
/** The stretches between landmarks that spheres hang on. */
export type Bone = (typeof bones.words)[number];
/** Parts that can be switched on together. */
export type BodyPartGroup = (typeof bodyPartGroups.words)[number];
/** What an engine makes of a capsule between two spheres. */
export type CapsuleProfile = (typeof capsuleProfiles.words)[number];
/** What the primitives are to do. */
export type FitMode = (typeof fitModes.words)[number];
/** How a landmark was found. */
export type LandmarkMethod = (typeof landmarkMethods.words)[number];
/** A unit of length. */
export type LengthUnit = (typeof lengthUnits.words)[number];
/** A file format that can be read. */
export type MeshFileFormat = (typeof meshFileFormats.words)[number];
/** What a part of a file is to the character. */
export type MeshPartKind = (typeof meshPartKinds.words)[number];
/** How much work goes into a fit. */
export type Quality = (typeof qualities.words)[number];
/** Whether the bust may be split in three. */
export type Sex = (typeof sexes.words)[number];
/** A form of weights that carry the spheres along. */
export type SkinningForm = (typeof skinningForms.words)[number];
/** A stage of a fit. */
export type Stage = (typeof stages.words)[number];
/** The axis that points up. */
export type UpAxis = (typeof upAxes.words)[number];
