#include <math.h>
#include <stdint.h>
/* par layout: see plant.py */
enum {P_p,P_R,P_Ld,P_Lq,P_satm,P_satq,P_c3,P_c3ph,P_l6,P_l6ph,P_J,P_Tc,P_Ts,P_ws,P_B,P_sig0,P_fang,
 P_fs,P_bw,P_vlim,P_dead,P_anoise,P_aoffa,P_aoffb,P_again_a,P_again_b,P_aq,P_alias,P_offe,P_ecc,P_eccph,P_ecc2,P_counts,P_zlog,
 P_mode,P_w0,P_hunt,P_fhunt,P_hunt1,P_iq,P_id,P_tsl,P_tgain,P_toff,P_tdrift,P_tnoise,P_Trise,P_Ttau,P_brake,P_turns,P_speedbw,P_usetab,P_period,P_nrow,P_ideal,P_th0,P_skip,P_mesh,P_meshratio,P_meshph,P_seed,P_dec,P_open,P_iqsign,P_Kt,P_dwell,P_oneway,P_elag,P_N};
static uint64_t s; static double uni(void){s^=s<<13;s^=s>>7;s^=s<<17;return (double)(s>>11)/9007199254740992.0;}
static double gau(void){double u=uni()+1e-300,v=uni();return sqrt(-2*log(u))*cos(6.283185307179586*v);}
static double look(const double*t,int n,double x){x-=floor(x);double f=x*n;int i=(int)f;if(i>=n)i=n-1;f-=i;return t[i]+(t[(i+1)%n]-t[i])*f;}
static double rowi(const double*t,int n,int c,double x){x-=floor(x);double f=x*n;int i=(int)f;if(i>=n)i=n-1;f-=i;return t[2*i+c]+(t[2*((i+1)%n)+c]-t[2*i+c])*f;}
double torque(const double*P,const double*kd,const double*kq,const double*cog,int ng,double th,double id,double iq,double km){
 double x=th/6.283185307179586,p=P[P_p],te=p*th;double KD=look(kd,ng,x)*km,KQ=look(kq,ng,x)*km;
 double sm=1/(1+P[P_satm]*(iq*iq));double lq=P[P_Lq]/(1+P[P_satq]*fabs(iq));
 double T=1.5*p*((KD*id+KQ*iq)*sm+(P[P_Ld]-lq)*id*iq+P[P_c3]*iq*fabs(iq)*iq*cos(6*te+P[P_c3ph])/(1+fabs(P[P_satm])*iq*iq)+P[P_l6]*3*(iq*iq)*sin(6*te+P[P_l6ph])+P[P_l6]*2*id*iq*cos(6*te+P[P_l6ph]));
 return T+look(cog,ng,x);}
/* out: 16 columns per record */
int sim(int n,const double*P,const double*kd,const double*kq,const double*cog,int ng,const double*tab,double*out,int maxout){
 s=88172645463325252ULL^(uint64_t)(P[P_seed]*7919+1);for(int k=0;k<20;k++)uni();
 double Ts=1/P[P_fs];int sub=4;double dt=Ts/sub,p=P[P_p];
 double th=P[P_th0],w=0,z=0,id=0,iq=0,ud=0,uq=0,vd=0,vq=0,vdn=0,vqn=0,xs=0,xw=0,wf=0,thl=-1e9,ipid=0,tsen=0,eid=0,eiq=0;int no=0;int mode=(int)P[P_mode];
 double thref=th,t=0;double walk=0,ang_l=th;
 double J=P[P_J];
 if(mode==0)w=P[P_w0];
 for(int k=0;k<n;k++){t=k*Ts;
  double enc=th+P[P_ecc]*sin(th+P[P_eccph])+P[P_ecc2]*sin(2*th+1);
  if(P[P_elag]>0){ang_l+=(enc-ang_l)*Ts/(P[P_elag]+Ts);enc=ang_l;}
  if(P[P_counts]>0)enc=floor(enc/6.283185307179586*P[P_counts])*6.283185307179586/P[P_counts];
  double thlog=enc+P[P_zlog];
  if(thl<-1e8){thl=enc;thref=enc;}
  double wr=(enc-thl)/Ts;thl=enc;wf+=(wr-wf)*(1-exp(-6.283*120*Ts));
  double te=p*th, tc=p*enc+P[P_offe], de=tc-te;
  /* true dq -> phases -> ADC -> drive dq */
  double ia=iq*sin(te)-id*cos(te),ib=iq*sin(te-2.0943951023931953)-id*cos(te-2.0943951023931953);
  double ma=ia*P[P_again_a]+P[P_aoffa]+P[P_anoise]*gau()+P[P_alias]*sin(6.283*37.3*t),mb=ib*P[P_again_b]+P[P_aoffb]+P[P_anoise]*gau()+P[P_alias]*sin(6.283*37.3*t+2);
  if(P[P_aq]>0){ma=floor(ma/P[P_aq]+.5)*P[P_aq];mb=floor(mb/P[P_aq]+.5)*P[P_aq];}
  double mc=-ma-mb;
  double mq=2./3*(ma*sin(tc)+mb*sin(tc-2.0943951023931953)+mc*sin(tc+2.0943951023931953));
  double md=-2./3*(ma*cos(tc)+mb*cos(tc-2.0943951023931953)+mc*cos(tc+2.0943951023931953));
  /* references */
  double rd=P[P_id],rq=P[P_iq];
  if(P[P_usetab]>0){double x=p*thlog/6.283185307179586/P[P_period];rd=rowi(tab,(int)P[P_nrow],0,x);rq=rowi(tab,(int)P[P_nrow],1,x);}
  double wref=P[P_w0];
  if(mode>=1){double ttot=n*Ts,ph=t;double half=ttot/2; if(P[P_oneway]==0){ if(t>half){wref=-wref;} if(t<P[P_dwell]||(t>half-P[P_dwell]&&t<half+P[P_dwell]))wref=0;}
   thref+=wref*Ts;double wc=wref+15*(thref-enc);double ew=wc-wf;double kp=J*6.283*P[P_speedbw]/P[P_Kt];xw+=ew*kp*6.283*P[P_speedbw]/4*Ts;rq=kp*ew+xw;if(P[P_usetab]>0){double x=p*thlog/6.283185307179586/P[P_period];rd=rowi(tab,(int)P[P_nrow],0,x);rq+=rowi(tab,(int)P[P_nrow],1,x);} }
  double wctrl=mode==0?w:wf;
  if(P[P_open]>0){rd=rq=0;}
  /* PI with decoupling, one period of delay */
  double bw=6.283*P[P_bw];
  eid=rd-md;eiq=rq-mq;
  double ld=P[P_Ld],lq=P[P_Lq];
  double nd=bw*ld*eid+ud,nq=bw*lq*eiq+uq; double wl=p*wctrl;
  double fd=nd-wl*lq*mq,fq=nq+wl*ld*md;
  double m=sqrt(fd*fd+fq*fq),lim=1;if(m>P[P_vlim]){lim=P[P_vlim]/m;}else{ud+=bw*P[P_R]*eid*Ts;uq+=bw*P[P_R]*eiq*Ts;}
  fd*=lim;fq*=lim;
  /* apply last period's voltage (drive frame, angle compensated) */
  double ca=vdn,cb=vqn;vdn=fd;vqn=fq;
  vd=ca*cos(de)-cb*sin(de);vq=ca*sin(de)+cb*cos(de);
  /* dead time per phase */
  if(P[P_dead]>0){double ic=-ia-ib;double ea=P[P_dead]*tanh(ia/0.05/(1+0*P[P_Kt])),eb=P[P_dead]*tanh(ib/0.05),ec=P[P_dead]*tanh(ic/0.05);double o=(ea+eb+ec)/3;ea-=o;eb-=o;ec-=o;
   vq-=2./3*(ea*sin(te)+eb*sin(te-2.0943951023931953)+ec*sin(te+2.0943951023931953));vd+=2./3*(ea*cos(te)+eb*cos(te-2.0943951023931953)+ec*cos(te+2.0943951023931953));}
  double T=0,Tf=0,dw=0,km=1-0.0012*P[P_Trise]*(P[P_Ttau]>0?1-exp(-t/P[P_Ttau]):1);
  for(int j=0;j<sub;j++){double x=th/6.283185307179586;double KD=look(kd,ng,x)*km,KQ=look(kq,ng,x)*km;double we=p*w;
   double lqs=P[P_Lq]/(1+P[P_satq]*fabs(iq));
   if(P[P_open]>0){id=iq=0;}
   else if(P[P_ideal]>0){double e=p*enc+P[P_offe]-p*th;/* drive frame -> true frame*/id=rd*cos(e)-rq*sin(e);iq=rd*sin(e)+rq*cos(e);}
   else{double di=(vd-P[P_R]*id+we*lqs*iq-we*KD)/P[P_Ld],dq=(vq-P[P_R]*iq-we*P[P_Ld]*id-we*KQ)/lqs;id+=di*dt;iq+=dq*dt;}
   T=torque(P,kd,kq,cog,ng,th,id,iq,km);
   if(P[P_mesh]!=0)T+=P[P_mesh]*sin(P[P_meshratio]*th+P[P_meshph]);
   double g=P[P_Tc]*(1+P[P_fang]*sin(th+2))+(P[P_Ts]-P[P_Tc])*exp(-(w*w)/(P[P_ws]*P[P_ws]));
   double zd=w-P[P_sig0]*fabs(w)/g*z;z+=zd*dt;if(z>2*g/P[P_sig0])z=2*g/P[P_sig0];if(z<-2*g/P[P_sig0])z=-2*g/P[P_sig0];
   Tf=P[P_sig0]*z+P[P_B]*w;
   if(mode==0){double o=w;double tt=t+j*dt;w=P[P_w0]*(1+P[P_hunt]*sin(6.283185*P[P_fhunt]*tt)+P[P_hunt1]*sin(th+.7));dw=(w-o)/dt;if(k==0)dw=0;}
   else{double br=mode==2?P[P_brake]*tanh(w/0.05)*(1+0.01*sin(th*1+.3)):0; dw=(T-Tf-br)/J;w+=dw*dt;}
   th+=w*dt;}
  double shaft=T-Tf-J*dw;if(mode!=0)shaft=0;
  walk=P[P_tdrift]*(1-exp(-t/20.));
  tsen+=(shaft-tsen)*(P[P_tsl]>0?1-exp(-Ts/P[P_tsl]):1);
  if(k%(int)P[P_dec]==0&&t>=P[P_skip]&&no<maxout){double*o=out+16*(no++);
   o[0]=t;o[1]=th;o[2]=thlog;o[3]=wf;o[4]=ma;o[5]=mb;o[6]=mc;o[7]=md;o[8]=mq*P[P_iqsign];o[9]=tsen*P[P_tgain]+P[P_toff]+walk+P[P_tnoise]*gau();o[10]=T;
   double x=th/6.283185307179586;double KD=look(kd,ng,x)*km*p*w,KQ=look(kq,ng,x)*km*p*w;
   o[11]=KQ*sin(te)-KD*cos(te);o[12]=KQ*sin(te-2.0943951023931953)-KD*cos(te-2.0943951023931953);
   o[13]=fd;o[14]=fq;o[15]=25+P[P_Trise]*(P[P_Ttau]>0?1-exp(-t/P[P_Ttau]):1);}
 }
 return no;}
